#include "sim/solve/bending_diagonal.h"

#include "sim/bending/angle.h"

namespace hysteron {

namespace {

std::vector<Eigen::Vector4i> hinge_corners(const ClothMesh& mesh) {
  std::vector<Eigen::Vector4i> result;
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const Edge& e = mesh.edge[i];
    result.push_back({e.p0, e.p1, e.p2, e.p3});
  }
  return result;
}

template <class Real>
std::vector<Real> hinge_aspects(const ClothMesh& mesh) {
  std::vector<Real> result;
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const Edge& e = mesh.edge[i];
    const double squared = (mesh.rest[e.p3] - mesh.rest[e.p2]).squaredNorm();
    result.push_back(static_cast<Real>(squared / (mesh.face_area[e.face0] + mesh.face_area[e.face1])));
  }
  return result;
}

Adjacency vertex_hinges(const ClothMesh& mesh) {
  const std::vector<Eigen::Vector4i> corner = hinge_corners(mesh);
  Adjacency rows;
  rows.start.assign(mesh.vertices() + 1, 0);
  for (const auto& c : corner)
    for (int k = 0; k < 4; ++k) ++rows.start[c[k] + 1];
  for (int v = 0; v < mesh.vertices(); ++v) rows.start[v + 1] += rows.start[v];
  rows.item.resize(rows.start.back());
  std::vector<int> next(rows.start.begin(), rows.start.end() - 1);
  for (std::size_t i = 0; i < corner.size(); ++i)
    for (int k = 0; k < 4; ++k) rows.item[next[corner[i][k]]++] = 4 * static_cast<int>(i) + k;
  return rows;
}

template <class Real>
HYST_HD inline Vec3<Real> angle_gradient(const Angle<Real>& a, int slot) {
  if (slot == 0) return a.g0;
  if (slot == 1) return a.g1;
  const Real w0 = slot == 2 ? 1 - a.t0 : a.t0, w1 = slot == 2 ? 1 - a.t1 : a.t1;
  return -w0 * a.g0 - w1 * a.g1;
}

}  // namespace

template <class Real, class Device>
BendingDiagonal<Real, Device>::BendingDiagonal(Device& device, const ClothMesh& mesh)
    : device_(device),
      corner_(device, hinge_corners(mesh)),
      aspect_(device, hinge_aspects<Real>(mesh)),
      block_(device, mesh.vertices()) {
  const Adjacency rows = vertex_hinges(mesh);
  start_ = Buffer<int, Device>(device, rows.start);
  item_ = Buffer<int, Device>(device, rows.item);
}

template <class Real, class Device>
void BendingDiagonal<Real, Device>::update(const Vec3<Real>* x, Real rigidity) {
  const Eigen::Vector4i* corner = corner_.data();
  const Real* aspect = aspect_.data();
  const int *start = start_.data(), *item = item_.data();
  Mat3<Real>* block = block_.data();
  for_each(
      device_, "bending diagonal", static_cast<int>(block_.size()), HYST_KERNEL(int v) {
        Mat3<Real> sum = Mat3<Real>::Zero();
        for (int j = start[v]; j < start[v + 1]; ++j) {
          const int hinge = item[j] / 4;
          const Eigen::Vector4i c = corner[hinge];
          const Vec3<Real> g =
              angle_gradient(dihedral_angle<Real>(x[c[0]], x[c[1]], x[c[2]], x[c[3]]), item[j] % 4);
          sum += (rigidity * aspect[hinge] * g) * g.transpose();
        }
        block[v] = sum;
      });
}

template <class Real, class Device>
std::size_t BendingDiagonal<Real, Device>::bytes() const {
  return corner_.bytes() + aspect_.bytes() + start_.bytes() + item_.bytes() + block_.bytes();
}

template class BendingDiagonal<double, ThisDevice>;
template class BendingDiagonal<float, ThisDevice>;

}  // namespace hysteron
