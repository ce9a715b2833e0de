#include "sim/linear/multigrid.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

namespace hysteron {

namespace {

// Weight of the finest level's diagonal beside the coarse levels.  Measured on flat, folded and rough cloth
// of 2,000 ... 300,000 triangles: 0.35 ... 1 make 10 % of difference.
constexpr double kFinestWeight = 0.6;
// Two sweeps of damped Jacobi whose dampings, over the largest eigenvalue, are those of the Chebyshev
// polynomial for the upper three quarters of the spectrum: 1/(5/8 -+ 3/8 cos(pi/4)).  Together they reduce
// that part to 0.22 at most and bear an eigenvalue found too small by a fifth.
constexpr double kDamping[2] = {1.1233, 2.7790};
// The eigenvalue found by kPowerSteps of power iteration is too small by some percent.
constexpr double kEigenvalueMargin = 1.1;
constexpr int kPowerSteps = 8;
// Linear interpolation bends at the edges of the coarse triangles, so that each coarser level's plate is too
// stiff; measured, half of it is best from the second level on.
constexpr double kPlateSoftening = 0.5;
constexpr int kMostDense = 96;  // nodes whose matrix is inverted densely

// What a level adds to the share of the plate that its matrix has from the finer one.
double plate_change(int level) {
  if (level == 0) return 1;
  return std::pow(kPlateSoftening, level) - std::pow(kPlateSoftening, level - 1);
}

// Inverse of a symmetric positive semidefinite block; a direction without stiffness of its own, beyond
// rounding, gets that of the rounding.  Zero for a zero block, which belongs to a node that nothing moves.
template <class Real>
HYST_HD inline Mat3<Real> safe_inverse(const Mat3<Real>& block) {
  const Real trace = block(0, 0) + block(1, 1) + block(2, 2);
  if (!(trace > 0)) return Mat3<Real>::Zero();
  Mat3<Real> scaled = block / trace;
  for (int k = 0; k < 3; ++k) scaled(k, k) += 2 * std::numeric_limits<Real>::epsilon();
  const Mat3<Real> inverse = scaled.inverse();  // by itself: within an expression Eigen inverts on the host
  return inverse / trace;
}

// L v with L L^T = block, lower triangular; zero rows stay zero.
template <class Real>
HYST_HD inline Vec3<Real> times_cholesky(const Mat3<Real>& block, const Vec3<Real>& v) {
  using std::sqrt;
  Mat3<Real> l = Mat3<Real>::Zero();
  for (int k = 0; k < 3; ++k)
    for (int i = k; i < 3; ++i) {
      Real rest = block(i, k);
      for (int m = 0; m < k; ++m) rest -= l(i, m) * l(k, m);
      if (i == k)
        l(k, k) = rest > 0 ? sqrt(rest) : Real(0);
      else
        l(i, k) = l(k, k) > 0 ? rest / l(k, k) : Real(0);
    }
  return l * v;
}

// Between -1 and 1.
template <class Real>
HYST_HD inline Vec3<Real> rough_vector(int i) {
  Vec3<Real> v;
  for (int k = 0; k < 3; ++k) {
    const unsigned hash = (3u * static_cast<unsigned>(i) + static_cast<unsigned>(k) + 1u) * 2654435761u;
    v[k] = static_cast<Real>(hash >> 16) / Real(32768) - 1;
  }
  return v;
}

}  // namespace

template <class Real, class Device>
Multigrid<Real, Device>::Multigrid(Device& device, const ClothMesh& mesh, const RestHierarchy& hierarchy)
    : device_(device), vertices_(mesh.vertices()), inverse_(device, mesh.vertices()) {
  for (const RestLevel& level : hierarchy) level_.emplace_back(device, level);
  if (level_.empty() || level_.back().nodes > kMostDense) return;
  const std::size_t blocks = static_cast<std::size_t>(level_.back().nodes) * level_.back().nodes;
  for (auto& matrix : dense_) matrix = Buffer<Eigen::Matrix3d, Device>(device, blocks);
}

template <class Real, class Device>
std::size_t Multigrid<Real, Device>::bytes() const {
  std::size_t sum = inverse_.bytes() + 2 * dense_[0].bytes();
  for (const auto& level : level_) sum += level.bytes();
  return sum;
}

template <class Real, class Device>
void Multigrid<Real, Device>::invert_diagonal(BlockRowsView<Real> matrix, const Mat3<Real>* added,
                                              const char* held, Mat3<Real>* inverse) {
  for_each(
      device_, "multigrid: diagonal", matrix.rows, HYST_KERNEL(int i) {
        Mat3<Real> block = matrix.diagonal[i];
        if (added) block += added[i];
        inverse[i] = held && held[i] ? Mat3<Real>(Mat3<Real>::Zero()) : safe_inverse<Real>(block);
      });
}

// Every block gathers its own sum, in the order of the finer nodes; in double, for its terms cancel.
template <class Real, class Device>
void Multigrid<Real, Device>::coarsen(BlockRowsView<Real> finer, const char* held,
                                      CoarseLevel<Real, Device>& level) {
  const CoarseLevelView<Real> coarse = level.view();
  const UpperBlock* upper = level.upper.data();
  for_each(
      device_, "multigrid: coarse matrix", static_cast<int>(level.upper.size()), HYST_KERNEL(int u) {
        const UpperBlock at = upper[u];
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (int k = coarse.start[at.row]; k < coarse.start[at.row + 1]; ++k) {
          const int i = coarse.item[k];
          if (held && held[i]) continue;
          const Real own = coarse.weight[k];
          const Real diagonal = own * coarse.finer[i].weight_of(at.column);
          if (diagonal != 0) sum += (diagonal * finer.diagonal[i]).template cast<double>();
          for (int j = finer.row_ptr[i]; j < finer.row_ptr[i + 1]; ++j) {
            const int other = finer.col[j];
            const Real weight = own * coarse.finer[other].weight_of(at.column);
            if (weight == 0 || (held && held[other])) continue;
            sum += (weight * finer.off_diagonal[j]).template cast<double>();
          }
        }
        if (at.slot < 0) {
          coarse.matrix.diagonal[at.row] = (0.5 * (sum + sum.transpose())).template cast<Real>();
        } else {
          coarse.matrix.off_diagonal[at.slot] = sum.template cast<Real>();
          coarse.matrix.off_diagonal[at.mirror] = sum.transpose().template cast<Real>();
        }
      });
}

template <class Real, class Device>
void Multigrid<Real, Device>::add_plate(Real rigidity, CoarseLevel<Real, Device>& level) {
  const BlockRowsView<Real> matrix = level.view().matrix;
  const Real *off_diagonal = level.plate_off_diagonal.data(), *diagonal = level.plate_diagonal.data();
  for_each(
      device_, "multigrid: plate", matrix.rows, HYST_KERNEL(int i) {
        for (int k = 0; k < 3; ++k) matrix.diagonal[i](k, k) += rigidity * diagonal[i];
        for (int j = matrix.row_ptr[i]; j < matrix.row_ptr[i + 1]; ++j)
          for (int k = 0; k < 3; ++k) matrix.off_diagonal[j](k, k) += rigidity * off_diagonal[j];
      });
}

// Power iteration on D^-1 A from a fixed rough vector in which stiff and soft directions have equal energies;
// Rayleigh quotients need no normalisation in between.
template <class Real, class Device>
void Multigrid<Real, Device>::find_eigenvalue(CoarseLevel<Real, Device>& level) {
  const CoarseLevelView<Real> v = level.view();
  Vec3<Real>*from = v.x, *to = v.y;
  for_each(
      device_, "multigrid: rough vector", v.nodes,
      HYST_KERNEL(int i) { from[i] = times_cholesky<Real>(v.inverse[i], rough_vector<Real>(i)); });
  double* inverse_eigenvalue = level.inverse_eigenvalue.data();
  for (int step = 0; step < kPowerSteps; ++step) {
    for_each_sum<2>(
        device_, "multigrid: eigenvalue", v.nodes,
        HYST_KERNEL(int i, Sums<2>& sums) {
          const Vec3<Real> product = v.matrix.times(i, from);
          sums.term[0] += static_cast<double>(from[i].dot(product));
          sums.term[1] += static_cast<double>(from[i].dot(v.matrix.diagonal[i] * from[i]));
          to[i] = v.inverse[i] * product;
        },
        HYST_KERNEL(const Sums<2>& total) {
          *inverse_eigenvalue = total.term[0] > 0 ? total.term[1] / (kEigenvalueMargin * total.term[0]) : 0;
        });
    std::swap(from, to);
  }
}

// Block Gauss-Jordan without pivoting, one launch for each pivot.
template <class Real, class Device>
void Multigrid<Real, Device>::invert_coarsest(CoarseLevel<Real, Device>& level) {
  const BlockRowsView<Real> matrix = level.view().matrix;
  const int n = matrix.rows;
  Eigen::Matrix3d *a = dense_[0].data(), *next = dense_[1].data();
  for_each(
      device_, "multigrid: dense matrix", n, HYST_KERNEL(int i) {
        for (int j = 0; j < n; ++j) a[i * n + j].setZero();
        a[i * n + i] = matrix.diagonal[i].template cast<double>();
        for (int j = matrix.row_ptr[i]; j < matrix.row_ptr[i + 1]; ++j)
          a[i * n + matrix.col[j]] = matrix.off_diagonal[j].template cast<double>();
      });
  for (int k = 0; k < n; ++k) {
    for_each(
        device_, "multigrid: dense inverse", n * n, HYST_KERNEL(int e) {
          const int i = e / n, j = e % n;
          const Eigen::Matrix3d pivot = safe_inverse<double>(a[k * n + k]);
          if (i == k)
            next[e] = j == k ? pivot : Eigen::Matrix3d(pivot * a[e]);
          else if (j == k)
            next[e] = -a[e] * pivot;
          else
            next[e] = a[e] - a[i * n + k] * (pivot * a[k * n + j]);
        });
    std::swap(a, next);
  }
}

template <class Real, class Device>
void Multigrid<Real, Device>::rebuild(BlockRowsView<Real> matrix, const Mat3<Real>* bending_diagonal,
                                      Real bending, const char* held) {
  held_ = held;
  invert_diagonal(matrix, bending_diagonal, held, inverse_.data());
  for (std::size_t l = 0; l < level_.size(); ++l) {
    CoarseLevel<Real, Device>& level = level_[l];
    coarsen(l == 0 ? matrix : level_[l - 1].view().matrix, l == 0 ? held : nullptr, level);
    add_plate(static_cast<Real>(plate_change(static_cast<int>(l))) * bending, level);
    invert_diagonal(level.view().matrix, nullptr, nullptr, level.inverse.data());
    find_eigenvalue(level);
  }
  if (dense()) invert_coarsest(level_.back());
}

// Right-hand side from the finer residual, and the first sweep from zero: x.
template <class Real, class Device>
void Multigrid<Real, Device>::restrict_to(CoarseLevel<Real, Device>& level, const Vec3<Real>* finer) {
  const CoarseLevelView<Real> v = level.view();
  const double damping = kDamping[0];
  for_each(
      device_, "multigrid: restrict", v.nodes, HYST_KERNEL(int i) {
        v.b[i] = v.restricted(i, finer);
        v.x[i] = static_cast<Real>(damping * *v.inverse_eigenvalue) * (v.inverse[i] * v.b[i]);
      });
}

// One sweep of damped Jacobi.
template <class Real, class Device>
void Multigrid<Real, Device>::sweep(CoarseLevel<Real, Device>& level, int which, const Vec3<Real>* from,
                                    Vec3<Real>* to) {
  const CoarseLevelView<Real> v = level.view();
  const double damping = kDamping[which];
  for_each(
      device_, "multigrid: sweep", v.nodes, HYST_KERNEL(int i) {
        const Vec3<Real> residual = v.b[i] - v.matrix.times(i, from);
        to[i] = from[i] + static_cast<Real>(damping * *v.inverse_eigenvalue) * (v.inverse[i] * residual);
      });
}

template <class Real, class Device>
void Multigrid<Real, Device>::residual(CoarseLevel<Real, Device>& level) {
  const CoarseLevelView<Real> v = level.view();
  for_each(
      device_, "multigrid: residual", v.nodes,
      HYST_KERNEL(int i) { v.x[i] = v.b[i] - v.matrix.times(i, v.y); });
}

template <class Real, class Device>
void Multigrid<Real, Device>::correct(CoarseLevel<Real, Device>& level, CoarseLevel<Real, Device>& coarser) {
  const CoarseLevelView<Real> v = level.view(), from = coarser.view();
  for_each(
      device_, "multigrid: correct", v.nodes, HYST_KERNEL(int i) { v.y[i] += from.finer[i].of(from.y); });
}

template <class Real, class Device>
void Multigrid<Real, Device>::solve_coarsest(CoarseLevel<Real, Device>& level) {
  const CoarseLevelView<Real> v = level.view();
  const Eigen::Matrix3d* inverse = dense_[v.nodes % 2].data();
  for_each(
      device_, "multigrid: coarsest", v.nodes, HYST_KERNEL(int i) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int j = 0; j < v.nodes; ++j)  // by columns, so that neighbouring threads read neighbours
          sum += inverse[j * v.nodes + i].transpose() * v.b[j].template cast<double>();
        v.y[i] = sum.template cast<Real>();
      });
}

template <class Real, class Device>
void Multigrid<Real, Device>::apply(const Vec3<Real>* r, Vec3<Real>* z) {
  const int last = static_cast<int>(level_.size()) - 1;
  for (int l = 0; l <= last; ++l) {
    restrict_to(level_[l], l == 0 ? r : level_[l - 1].x.data());
    if (l == last && dense()) break;
    sweep(level_[l], 1, level_[l].x.data(), level_[l].y.data());
    if (l < last) residual(level_[l]);
  }
  if (dense()) solve_coarsest(level_[last]);
  for (int l = dense() ? last - 1 : last; l >= 0; --l) {
    if (l < last) correct(level_[l], level_[l + 1]);
    sweep(level_[l], 0, level_[l].y.data(), level_[l].x.data());
    sweep(level_[l], 1, level_[l].x.data(), level_[l].y.data());
  }
  const char* held = held_;
  const Mat3<Real>* inverse = inverse_.data();
  const bool coarse = last >= 0;
  const DeviceInterpolation<Real>* finer = coarse ? level_[0].finer.data() : nullptr;
  const Vec3<Real>* correction = coarse ? level_[0].y.data() : nullptr;
  const Real weight = coarse ? Real(kFinestWeight) : Real(1);
  for_each(
      device_, "multigrid: combine", vertices_, HYST_KERNEL(int i) {
        Vec3<Real> sum = Vec3<Real>::Zero();
        if (!held[i]) {
          sum = weight * (inverse[i] * r[i]);
          if (coarse) sum += finer[i].of(correction);
        }
        z[i] = sum;
      });
}

template class Multigrid<double, ThisDevice>;
template class Multigrid<float, ThisDevice>;

}  // namespace hysteron
