#include "sim/linear/multigrid.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sim/linear/level_setup.h"
#include "sim/linear/levels_in_one_launch.h"

namespace hysteron {

namespace {

// The weight of the finest level's diagonal beside the coarse levels.  Measured on flat, folded and rough
// cloth of 2,000 ... 300,000 triangles, 0.35 ... 1 make 10 % of difference.
constexpr double kFinestWeight = 0.6;
// Linear interpolation bends at the edges of the coarse triangles, so that each coarser level's plate is too
// stiff; measured, half of it is best from the second level on.
constexpr double kPlateSoftening = 0.5;

template <class Real, class Device>
Kernel smoothing_kernel(const CoarseLevel<Real, Device>& level) {
  return {"multigrid: sweep", level.matrix_bytes() + total_bytes(level.inverse, level.b, level.x, level.y)};
}

// Returns the change that a level makes to the share of the plate that its matrix has from the finer one.
double plate_change(int level) {
  if (level == 0) return 1;
  return std::pow(kPlateSoftening, level) - std::pow(kPlateSoftening, level - 1);
}

// Sums with as many blocks as an H100 runs at once, unless the solve is one launch.
template <class Device, class Body, class Finish>
void sum_over_vertices(Device& device, const Kernel& kernel, int n, const Body& body, const Finish& finish) {
  if constexpr (Device::kGpu) {
    if (n > kMaxRowsInOneLaunch) return for_each_sum<1>(device, kernel, n, body, finish, kMaxSumBlocksEach);
  }
  for_each_sum<1>(device, kernel, n, body, finish);
}

}  // namespace

template <class Real, class Device>
Multigrid<Real, Device>::Multigrid(Device& device, const ClothMesh& mesh, const RestHierarchy& hierarchy)
    : device_(device), vertices_(mesh.vertices()), inverse_(device, mesh.vertices()) {
  using Dense = DenseInverse<Real, Device>;
  for (const RestLevel& level : hierarchy) {
    level_.emplace_back(device, level);
    if (level.nodes <= Dense::enough(device)) break;
  }
  if (!level_.empty() && level_.back().nodes <= Dense::most(device))
    dense_.emplace(device, level_.back().nodes);
}

template <class Real, class Device>
std::size_t Multigrid<Real, Device>::bytes() const {
  std::size_t sum = inverse_.bytes() + (dense_ ? dense_->bytes() : 0);
  for (const auto& level : level_) sum += level.bytes();
  return sum;
}

template <class Real, class Device>
void Multigrid<Real, Device>::invert_diagonal(BlockRowsView<Real> matrix, const Mat3<Real>* added,
                                              const char* held, Mat3<Real>* inverse) {
  for_each(
      device_, {"multigrid: diagonal", (added ? 3 : 2) * inverse_.bytes()}, matrix.rows, HYST_KERNEL(int i) {
        Mat3<Real> block = matrix.diagonal[i];
        if (added) block += added[i];
        inverse[i] = held && held[i] ? Mat3<Real>(Mat3<Real>::Zero()) : safe_inverse<Real>(block);
      });
}

template <class Real, class Device>
void Multigrid<Real, Device>::coarsen(BlockRowsView<Real> finer, const char* held, Real rigidity,
                                      CoarseLevel<Real, Device>& level) {
  // beside the finer matrix
  const std::size_t bytes = level.gather_bytes() + total_bytes(level.finer, level.upper, level.off_diagonal,
                                                               level.diagonal, level.inverse);
  for_each_row(device_, {"multigrid: coarse matrix", bytes}, static_cast<int>(level.upper.size()),
               Coarsening<Real>{finer, held, level.view(), level.upper.data(),
                                level.plate_off_diagonal.data(), level.plate_diagonal.data(), rigidity});
}

template <class Real, class Device>
void Multigrid<Real, Device>::find_eigenvalue(CoarseLevel<Real, Device>& level) {
  const CoarseLevelView<Real> v = level.view();
  for_each(device_, {"multigrid: rough vector", total_bytes(level.inverse, level.x)}, v.nodes,
           RoughStart<Real>{v});
  const Kernel power = {"multigrid: power",
                        level.matrix_bytes() + total_bytes(level.inverse, level.x, level.y)};
  for (int step = 1; step < kPowerSteps; ++step)
    for_each_block_row(device_, power, v.nodes,
                       PowerStep<Real>{v, step % 2 ? v.x : v.y, step % 2 ? v.y : v.x});
  for_each_block_row_sum<2>(
      device_, {"multigrid: eigenvalue", level.matrix_bytes() + level.y.bytes()}, v.nodes,
      RayleighTerms<Real>{v},
      HYST_KERNEL(const Sums<2>& total) { *v.inverse_eigenvalue = inverse_eigenvalue(total); });
}

template <class Real, class Device>
void Multigrid<Real, Device>::rebuild(BlockRowsView<Real> matrix, const Mat3<Real>* bending_diagonal,
                                      Real bending, const char* held) {
  held_ = held;
  invert_diagonal(matrix, bending_diagonal, held, inverse_.data());
  for (std::size_t l = 0; l < level_.size(); ++l)
    coarsen(l == 0 ? matrix : level_[l - 1].view().matrix, l == 0 ? held : nullptr,
            static_cast<Real>(plate_change(static_cast<int>(l))) * bending, level_[l]);
  for (int l = 0; l < swept(); ++l) {
    if (may_take_one_launch(device_) && has_view_from(l) && level_[l].nodes <= kMaxNodesInOneLaunch &&
        eigenvalues_in_one_launch(device_, view_from(l)))
      break;
    find_eigenvalue(level_[l]);
  }
  if (dense_) dense_->make(device_, level_.back().view().matrix);
}

template <class Real, class Device>
void Multigrid<Real, Device>::sweep(CoarseLevel<Real, Device>& level, const int* stop) {
  const CoarseLevelView<Real> v = level.view();
  const Kernel sweep = smoothing_kernel(level);
  for_each_block_row(device_, sweep, v.nodes, JacobiSweep<Real>{v, kFirstDamping, v.y, v.x}, stop);
  for_each_block_row(device_, sweep, v.nodes, JacobiSweep<Real>{v, kSecondDamping, v.x, v.y}, stop);
}

template <class Real, class Device>
void Multigrid<Real, Device>::apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) {
  descend(r, scalars);
  ascend(scalars);
  combine(combination(r, z, scalars), scalars);
}

template <class Real, class Device>
bool Multigrid<Real, Device>::step_and_apply(const Advance<Real>& step, Vec3<Real>* z, PcgScalars* scalars) {
  descend(NextResidual<Real>{step}, scalars);
  ascend(scalars);
  Combination<Real> last = combination(step.r, z, scalars);
  last.step = step;
  combine(last, scalars);
  return true;
}

// Leads from the residual to the coarsest level's y.
template <class Real, class Device>
template <class Vector>
void Multigrid<Real, Device>::descend(const Vector& residual, const PcgScalars* scalars) {
  const int* stop = scalars ? &scalars->done : nullptr;
  for (int l = 0; l < coarse(); ++l) {
    const CoarseLevel<Real, Device>& level = level_[l];
    const CoarseLevelView<Real> v = level_[l].view();
    const std::size_t finer =
        (std::is_pointer_v<Vector> || l > 0 ? 1 : 2) * level.finer.size() * sizeof(Vec3<Real>);
    const Kernel restriction = {"multigrid: restrict",
                                level.gather_bytes() + finer + total_bytes(level.inverse, level.b, level.x)};
    if (l == 0)
      for_each_block_row(device_, restriction, v.nodes, Restriction<Real, Vector>{v, residual, l < swept()},
                         stop);
    else
      for_each_block_row(device_, restriction, v.nodes,
                         Restriction<Real>{v, level_[l - 1].view().x, l < swept()}, stop);
    if (l == swept()) return dense_->apply(device_, v.b, v.y, stop);
    for_each_block_row(device_, smoothing_kernel(level), v.nodes,
                       JacobiSweep<Real>{v, kSecondDamping, v.x, v.y}, stop);
    const Kernel residual_kernel = {"multigrid: residual",
                                    level.matrix_bytes() + total_bytes(level.b, level.x, level.y)};
    if (l + 1 < coarse()) for_each_block_row(device_, residual_kernel, v.nodes, LevelResidual<Real>{v}, stop);
  }
}

// Leads back to the first level's y.
template <class Real, class Device>
void Multigrid<Real, Device>::ascend(const PcgScalars* scalars) {
  const int* stop = scalars ? &scalars->done : nullptr;
  for (int l = swept() - 1; l >= 0; --l) {
    if (l + 1 < coarse())
      for_each(
          device_,
          {"multigrid: correct", total_bytes(level_[l + 1].finer, level_[l + 1].y, level_[l].y, level_[l].y)},
          level_[l].nodes, CoarseCorrection<Real>{level_[l].view(), level_[l + 1].view()});
    sweep(level_[l], stop);
  }
}

template <class Real, class Device>
void Multigrid<Real, Device>::combine(const Combination<Real>& combination, PcgScalars* scalars) {
  const std::size_t vectors = (combination.step.q ? 7 : 2) * vertices_ * sizeof(Vec3<Real>),
                    from_coarse = coarse() > 0 ? total_bytes(level_[0].finer, level_[0].y) : 0;
  sum_over_vertices(
      device_, {"multigrid: combine", inverse_.bytes() + vectors + from_coarse}, vertices_, combination,
      HYST_KERNEL(const Sums<1>& total) {
        if (scalars) scalars->advance(total.term[0]);
      });
}

template <class Real, class Device>
Combination<Real> Multigrid<Real, Device>::combination(const Vec3<Real>* r, Vec3<Real>* z,
                                                       const PcgScalars* scalars) const {
  if (level_.empty()) return {held_, inverse_.data(), Real(1), nullptr, nullptr, r, z, scalars, {}};
  const CoarseLevel<Real, Device>& first = level_[0];
  return {held_, inverse_.data(), Real(kFinestWeight), first.finer.data(), first.y.data(), r, z, scalars, {}};
}

template <class Real, class Device>
bool Multigrid<Real, Device>::has_view_from(int first) const {
  return coarse() - first <= CycleView<Real>::kMax;
}

template <class Real, class Device>
CycleView<Real> Multigrid<Real, Device>::view_from(int first) {
  CycleView<Real> view;
  if constexpr (Device::kGpu) {
    view.levels = coarse() - first;
    view.swept = swept() - first;
    for (int l = 0; l < view.levels; ++l) view.level[l] = level_[first + l].view();
    if (dense_) view.dense = dense_->row(level_.back().b.data(), level_.back().y.data());
    view.combination = combination(nullptr, nullptr, nullptr);
  }
  return view;
}

template <class Real, class Device>
bool Multigrid<Real, Device>::in_one_launch(OneLaunchView<Real>& view) {
  if (!Device::kGpu || !has_view_from(0)) return false;
  view.kind = OneLaunchView<Real>::kCycle;
  view.cycle = view_from(0);
  return true;
}

template class Multigrid<double, ThisDevice>;
template class Multigrid<float, ThisDevice>;

}  // namespace hysteron
