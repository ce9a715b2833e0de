#include "sim/solve/assembled_stiffness.h"

#include <algorithm>
#include <set>

namespace hysteron {

AssembledStiffness::AssembledStiffness(const ClothMesh& mesh, const CurvatureOperator& op) : op_(op) {
  for (int h = 0; h < mesh.interior_edges; ++h) {
    const Edge& e = mesh.edge[h];
    corner_.emplace_back(e.p0, e.p1, e.p2, e.p3);
  }
  build_stencils(mesh);
  build_pattern(mesh);
}

void AssembledStiffness::build_stencils(const ClothMesh& mesh) {
  stencil_.start = {0};
  std::vector<std::vector<int>> places(mesh.vertices());
  local_.resize(4 * op_.hinge.item.size());
  for (int e = 0; e < op_.elements(); ++e) {
    std::set<int> vertices;
    for (int j = op_.hinge.start[e]; j < op_.hinge.start[e + 1]; ++j)
      for (int s = 0; s < 4; ++s) vertices.insert(corner_[op_.hinge.item[j]][s]);
    const std::vector<int> sorted(vertices.begin(), vertices.end());
    for (int j = op_.hinge.start[e]; j < op_.hinge.start[e + 1]; ++j)
      for (int s = 0; s < 4; ++s)
        local_[4 * j + s] = static_cast<int>(
            std::lower_bound(sorted.begin(), sorted.end(), corner_[op_.hinge.item[j]][s]) - sorted.begin());
    for (int v : sorted) {
      places[v].push_back(static_cast<int>(stencil_.item.size()));
      stencil_.item.push_back(v);
      element_of_.push_back(e);
    }
    stencil_.start.push_back(static_cast<int>(stencil_.item.size()));
  }
  vertex_stencil_.start = {0};
  for (const auto& row : places) {
    vertex_stencil_.item.insert(vertex_stencil_.item.end(), row.begin(), row.end());
    vertex_stencil_.start.push_back(static_cast<int>(vertex_stencil_.item.size()));
  }
  gradient_.resize(stencil_.item.size() * 3 * op_.dimension);
}

void AssembledStiffness::build_pattern(const ClothMesh& mesh) {
  const int n = mesh.vertices();
  std::vector<std::vector<int>> below(n);
  const auto pair = [&](int a, int b) {
    if (a != b) below[std::min(a, b)].push_back(std::max(a, b));
  };
  for (const auto& f : mesh.face)
    for (int k = 0; k < 3; ++k) pair(f[k], f[(k + 1) % 3]);
  for (int e = 0; e < op_.elements(); ++e)
    for (int a = stencil_.start[e]; a < stencil_.start[e + 1]; ++a)
      for (int b = stencil_.start[e]; b < a; ++b) pair(stencil_.item[a], stencil_.item[b]);
  lower_.start = {0};
  for (auto& row : below) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    lower_.item.insert(lower_.item.end(), row.begin(), row.end());
    lower_.start.push_back(static_cast<int>(lower_.item.size()));
  }
  lower_matrix_.resize(3 * n, 3 * n);
  Eigen::VectorXi counts(3 * n);
  for (int v = 0; v < n; ++v)
    for (int c = 0; c < 3; ++c) counts[3 * v + c] = 3 - c + 3 * (lower_.start[v + 1] - lower_.start[v]);
  lower_matrix_.reserve(counts);
  for (int v = 0; v < n; ++v)
    for (int c = 0; c < 3; ++c) {
      for (int r = c; r < 3; ++r) lower_matrix_.insert(3 * v + r, 3 * v + c) = 0;
      for (int j = lower_.start[v]; j < lower_.start[v + 1]; ++j)
        for (int r = 0; r < 3; ++r) lower_matrix_.insert(3 * lower_.item[j] + r, 3 * v + c) = 0;
    }
  lower_matrix_.makeCompressed();
}

std::size_t AssembledStiffness::bytes() const {
  return gradient_.size() * sizeof(double) + lower_matrix_.nonZeros() * (sizeof(double) + sizeof(int)) +
         (local_.size() + 3 * stencil_.item.size() + lower_.item.size()) * sizeof(int);
}

template <class Real>
void AssembledStiffness::compute_gradients(Cpu& cpu, const StiffnessView<Real>& bending) {
  const int d = op_.dimension;
  for_each(cpu, "assemble: curvature gradients", op_.elements(), [&](int e) {
    const int first = stencil_.start[e];
    std::fill(gradient_.begin() + first * 3L * d, gradient_.begin() + stencil_.start[e + 1] * 3L * d, 0.0);
    for (int j = op_.hinge.start[e]; j < op_.hinge.start[e + 1]; ++j)
      for (int s = 0; s < 4; ++s) {
        const Vec3<Real> g = angle_gradient(bending.gradient + 8 * op_.hinge.item[j], s);
        double* to = gradient_.data() + (first + local_[4 * j + s]) * 3L * d;
        for (int k = 0; k < d; ++k)
          for (int c = 0; c < 3; ++c) to[3 * k + c] += op_.coefficient[j * d + k] * static_cast<double>(g[c]);
      }
  });
}

void AssembledStiffness::add_block(int column, int place, const Eigen::Matrix3d& block) {
  const int* start = lower_matrix_.outerIndexPtr() + 3 * column;
  double* value = lower_matrix_.valuePtr();
  for (int c = 0; c < 3; ++c)
    for (int r = place < 0 ? c : 0; r < 3; ++r)
      value[start[c] + (place < 0 ? r - c : 3 - c + 3 * place + r)] += block(r, c);
}

template <class Real>
void AssembledStiffness::fill_column(int v, const BlockRowsView<Real>& matrix,
                                     const StiffnessView<Real>& bending, const char* held) {
  double* value = lower_matrix_.valuePtr();
  const int* start = lower_matrix_.outerIndexPtr();
  std::fill(value + start[3 * v], value + start[3 * v + 3], 0.0);
  if (held[v]) return add_block(v, -1, Eigen::Matrix3d::Identity());
  const auto begin = lower_.item.begin() + lower_.start[v], end = lower_.item.begin() + lower_.start[v + 1];
  const auto place_of = [&](int w) { return static_cast<int>(std::lower_bound(begin, end, w) - begin); };
  add_block(v, -1, matrix.diagonal[v].template cast<double>());
  for (int j = matrix.start[v]; j < matrix.start[v + 1]; ++j)
    if (matrix.column[j] > v && !held[matrix.column[j]])
      add_block(v, place_of(matrix.column[j]), matrix.off[j].template cast<double>().transpose());
  const int d = op_.dimension;
  for (int j = vertex_stencil_.start[v]; j < vertex_stencil_.start[v + 1]; ++j) {
    const int here = vertex_stencil_.item[j], e = element_of_[here];
    const Real* t = bending.tangent_area + e * (d * (d + 1) / 2);
    const double* g = gradient_.data() + here * 3L * d;
    Eigen::Matrix3d moved = Eigen::Matrix3d::Zero();  // rows: components of A dM/dK G_v
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b) {
        const double stiff = static_cast<double>(a >= b ? t[a * (a + 1) / 2 + b] : t[b * (b + 1) / 2 + a]);
        for (int c = 0; c < 3; ++c) moved(a, c) += stiff * g[3 * b + c];
      }
    for (int other = here; other < stencil_.start[e + 1]; ++other) {
      const int w = stencil_.item[other];
      if (held[w]) continue;
      const double* k = gradient_.data() + other * 3L * d;
      Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
      for (int a = 0; a < d; ++a)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) block(r, c) += k[3 * a + r] * moved(a, c);
      add_block(v, w == v ? -1 : place_of(w), block);
    }
  }
}

template <class Real>
const Eigen::SparseMatrix<double>& AssembledStiffness::assemble(Cpu& cpu, const BlockRowsView<Real>& matrix,
                                                                const StiffnessView<Real>& bending,
                                                                const char* held) {
  compute_gradients(cpu, bending);
  for_each(cpu, "assemble: columns", matrix.rows, [&](int v) { fill_column(v, matrix, bending, held); });
  return lower_matrix_;
}

template const Eigen::SparseMatrix<double>& AssembledStiffness::assemble(Cpu&, const BlockRowsView<double>&,
                                                                         const StiffnessView<double>&,
                                                                         const char*);
template const Eigen::SparseMatrix<double>& AssembledStiffness::assemble(Cpu&, const BlockRowsView<float>&,
                                                                         const StiffnessView<float>&,
                                                                         const char*);

}  // namespace hysteron
