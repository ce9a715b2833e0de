#include "sim/linear/dissected_factorisation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/device/archive_buffer.h"

namespace hysteron {

namespace {

// The time that an iteration of conjugate gradients takes an H100 beside the application [us].
constexpr double kIteration = 8;
constexpr int kMinRefactorThreshold = 6;  // as on the CPU

template <class Real>
void sweep_level(Cpu& cpu, const Buffer<SweptFront, Cpu>& fronts, int /*tiles*/, int /*pivots*/) {
  const SweptFront* front = fronts.data();
  for_each(cpu, {"fronts: sweep"}, static_cast<int>(fronts.size()), [=](int f) { sweep<Real>(front[f]); });
}
#ifdef __CUDACC__
template <class Real>
void sweep_level(Cuda& cuda, const Buffer<SweptFront, Cuda>& fronts, int tiles, int pivots) {
  sweep_fronts<Real>(cuda, ManyFronts{fronts.data(), static_cast<int>(fronts.size())}, tiles, pivots,
                     {"fronts: sweep"});
}
#endif

// Checks that loops can count a level's numbers with int.
void check_size(const TiledPlan& plan) {
  double most = static_cast<double>(plan.numbers);
  for (const std::vector<int>& level : plan.level)
    for (const int f : level)
      most = std::max(most, static_cast<double>(level.size()) * std::pow(plan.front[f].stride(), 2));
  if (most > std::numeric_limits<int>::max())
    throw Error::system("the linear system is too large to be factorised: linear-solver = multigrid");
}

// A number of a level's fronts, each of which is given most x most of them.
struct NumberOfLevel {
  FrontOfLevel front;
  int row, column;
  HYST_HD NumberOfLevel(const FrontOfLevel* fronts, int most, int e)
      : front(fronts[e / (most * most)]), row(e % (most * most) / most), column(e % most) {}
  // Is it below the diagonal, or on it?
  HYST_HD bool is_lower() const { return column <= row && row < front.stride; }
};

}  // namespace

template <class Real, class Device>
DissectedFactorisation<Real, Device>::DissectedFactorisation(Device& device,
                                                             std::unique_ptr<DefiniteMatrix<Real>> definite,
                                                             std::optional<DissectionShape> shape)
    : device_(device),
      definite_(std::move(definite)),
      matrix_(device, definite_->pattern()),
      pairs_(device, static_cast<int>(matrix_.row_ptr().size()) - 1),
      scale_(device, 3 * (matrix_.row_ptr().size() - 1)),
      b_(device, matrix_.row_ptr().size() - 1) {
  SparsityPattern always = CouplingList(matrix_.pattern()).take();
  shape_ = shape ? *shape : choose_shape(always);
  take_couplings(std::move(always));
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::take_couplings(SparsityPattern couplings) {
  couplings_ = std::move(couplings);
  plan_ = plan_dissection(couplings_, shape_);
  check_size(plan_);
  pairs_.take_plan(plan_);
  const FrontTables tables = make_front_tables(plan_, matrix_.pattern());
  number_ = {};  // releases the old numbers first
  number_ = Buffer<double, Device>(device_, plan_.numbers);
  std::size_t scratch = 0;
  for (const TiledFront& front : plan_.front) scratch += SweptFront::scratch_of(front.tiles);
  scratch_ = Buffer<double, Device>(device_, scratch);
  source_ = Buffer<int, Device>(device_, tables.source);
  child_row_ = Buffer<int, Device>(device_, tables.child_row);
  term_ = Buffer<FrontTerm, Device>(device_, tables.term);
  child_ = Buffer<FrontChild, Device>(device_, tables.child);
  block_ = Buffer<FrontBlock, Device>(device_, tables.block);
  ones_ = Buffer<std::size_t, Device>(device_, tables.ones);
  make_levels(tables);
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::make_levels(const FrontTables& tables) {
  level_.clear();
  double* scratch = scratch_.data();
  for (std::size_t l = 0; l < plan_.level.size(); ++l) {
    std::vector<SweptFront> swept;
    Level level;
    for (const int f : plan_.level[l]) {
      const TiledFront& front = plan_.front[f];
      swept.push_back({number_.data() + front.number, front.tiles, front.pivot_tiles, scratch});
      scratch += SweptFront::scratch_of(front.tiles);
      level.tiles = std::max(level.tiles, front.tiles);
      level.pivot_tiles = std::max(level.pivot_tiles, front.pivot_tiles);
    }
    level.front = Buffer<FrontOfLevel, Device>(device_, tables.front[l]);
    level.swept = Buffer<SweptFront, Device>(device_, swept);
    level.above = Buffer<RowAbove, Device>(device_, tables.above[l]);
    level.solved = Buffer<SolvedRow, Device>(device_, tables.solved[l]);
    level_.push_back(std::move(level));
  }
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::renew(const LinearSystem<Real, Device>& system, const char* held) {
  pairs_.take(system.pairs);
  if (!pairs_.fit()) take_couplings(pairs_.couplings_with(matrix_.pattern()));
  take_matrix(definite_->assemble(system.matrix));
  factorise(held);
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::take_matrix(const BlockRowsView<Real>& rows) {
  const BlockRowsView<Real> own = matrix_.view();
  const int blocks = static_cast<int>(matrix_.col().size());
  for_each(
      device_, {"fronts: matrix", 2 * (blocks + own.rows) * sizeof(Mat3<Real>)}, blocks + own.rows,
      HYST_KERNEL(int k) {
        if (k < blocks)
          own.off_diagonal[k] = rows.off_diagonal[k];
        else
          own.diagonal[k - blocks] = rows.diagonal[k - blocks];
      });
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::factorise(const char* held) {
  fill(held);
  pairs_.add(held, scale_.data(), number_.data());
  for (int l = 0; l < static_cast<int>(level_.size()); ++l) {
    if (l > 0) extend_add(l);
    sweep_level<Real>(device_, level_[l].swept, level_[l].tiles, level_[l].pivot_tiles);
  }
  for (int l = 0; l < static_cast<int>(level_.size()); ++l) finish(l);
}

// Fills in the matrix's lower triangle, scaled to a diagonal of ones, even for nodes that nothing moves.
template <class Real, class Device>
void DissectedFactorisation<Real, Device>::fill(const char* held) {
  const BlockRowsView<Real> matrix = matrix_.view();
  double *number = number_.data(), *scale = scale_.data();
  const int numbers = static_cast<int>(number_.size()), unknowns = 3 * matrix.rows;
  for_each(
      device_, {"fronts: zeros", total_bytes(number_, scale_)}, std::max(numbers, unknowns),
      HYST_KERNEL(int k) {
        using std::sqrt;
        if (k < numbers) number[k] = 0;
        if (k >= unknowns) return;
        const double diagonal = static_cast<double>(matrix.diagonal[k / 3](k % 3, k % 3));
        scale[k] = diagonal > 0 && !held[k / 3] ? 1 / sqrt(diagonal) : 1.0;
      });
  const FrontBlock* block = block_.data();
  const std::size_t* one = ones_.data();
  const int blocks = static_cast<int>(block_.size());
  for_each(
      device_, {"fronts: blocks"}, blocks + static_cast<int>(ones_.size()), HYST_KERNEL(int k) {
        if (k >= blocks) {
          number[one[k - blocks]] = 1;
          return;
        }
        const FrontBlock at = block[k];
        const bool on_diagonal = at.slot < 0, none = held[at.row] || held[at.column];
        const Mat3<Real>& from = on_diagonal ? matrix.diagonal[at.row] : matrix.off_diagonal[at.slot];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < (on_diagonal ? r + 1 : 3); ++c) {
            double value =
                none ? 0 : static_cast<double>(from(r, c)) * scale[3 * at.row + r] * scale[3 * at.column + c];
            if (on_diagonal && r == c) value = 1;
            number[at.number + static_cast<std::size_t>(r) * at.stride + c] = value;
          }
      });
}

// Adds the updates that the sweeps of children have left, child after child.
template <class Real, class Device>
void DissectedFactorisation<Real, Device>::extend_add(int level) {
  const FrontOfLevel* front = level_[level].front.data();
  const FrontChild* child = child_.data();
  const int *child_row = child_row_.data(), most = level_[level].stride();
  double* number = number_.data();
  for_each(
      device_, {"fronts: take over"}, level_[level].fronts() * most * most, HYST_KERNEL(int e) {
        const NumberOfLevel at(front, most, e);
        if (!at.is_lower()) return;
        double sum = 0;
        for (int k = at.front.first_child; k < at.front.end_child; ++k) {
          const FrontChild from = child[k];
          const int i = child_row[from.row_start + at.row], j = child_row[from.row_start + at.column];
          if (i < 0 || j < 0) continue;
          const std::size_t row = i > j ? i : j;
          sum += number[from.number + row * from.stride + (i > j ? j : i)];
        }
        number[at.front.number + static_cast<std::size_t>(at.row) * at.front.stride + at.column] += sum;
      });
}

// Completes P^-1, C P^-1 and its mirror image, which is minus its transpose, for the unscaled matrix.
template <class Real, class Device>
void DissectedFactorisation<Real, Device>::finish(int level) {
  const FrontOfLevel* front = level_[level].front.data();
  const int *source = source_.data(), most = level_[level].stride();
  const double* scale = scale_.data();
  double* number = number_.data();
  for_each(
      device_, {"fronts: finish"}, level_[level].fronts() * most * most, HYST_KERNEL(int e) {
        const NumberOfLevel at(front, most, e);
        if (!at.is_lower() || at.column >= at.front.pivot_rows) return;
        const int i = source[at.front.source + at.row], j = source[at.front.source + at.column];
        if (i < 0 || j < 0) return;
        const std::size_t stride = at.front.stride, entry = at.front.number + at.row * stride + at.column,
                          mirror = at.front.number + at.column * stride + at.row;
        const bool is_pivot = at.row < at.front.pivot_rows;
        const double value =
            is_pivot ? -number[entry] * scale[i] * scale[j] : number[entry] * scale[j] / scale[i];
        number[entry] = value;
        number[mirror] = is_pivot ? value : -value;
      });
}

template <class Real, class Device>
FrontsView<Real> DissectedFactorisation<Real, Device>::view() const {
  FrontsView<Real> view;
  view.levels = static_cast<int>(level_.size());
  view.number = number_.data();
  view.source = source_.data();
  view.term = term_.data();
  for (int l = 0; l < view.levels; ++l) {
    view.above[l] = level_[l].above.data();
    view.solved[l] = level_[l].solved.data();
    view.above_rows[l] = static_cast<int>(level_[l].above.size());
    view.solved_rows[l] = static_cast<int>(level_[l].solved.size());
  }
  view.b = const_cast<Real*>(b_.data()->data());
  return view;
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) {
  const FrontsView<Real> fronts = view();
  const int* stop = scalars ? &scalars->done : nullptr;
  const Real* from = r->data();
  Real* to = z->data();
  for (int l = 0; l + 1 < fronts.levels; ++l)
    for_each_row(device_, {"fronts: up"}, fronts.above_rows[l], fronts.up(l, from), stop);
  for (int l = fronts.levels - 1; l > 0; --l)
    for_each_row(device_, {"fronts: down"}, fronts.solved_rows[l], fronts.down(l, from, to), stop);
  for_each_row_sum<1>(
      device_, {"fronts: last down"}, fronts.solved_rows[0],
      LastRowDown<Real>{fronts.down(0, from, to), scalars}, HYST_KERNEL(const Sums<1>& total) {
        if (scalars) scalars->advance(total.term[0]);
      });
}

template <class Real, class Device>
bool DissectedFactorisation<Real, Device>::in_one_launch(OneLaunchView<Real>& to) {
  to.kind = OneLaunchView<Real>::kFronts;
  to.fronts = view();
  return true;
}

template <class Real, class Device>
int DissectedFactorisation<Real, Device>::refactor_threshold() const {
  return std::max(kMinRefactorThreshold,
                  static_cast<int>(plan_.cost.renewal / (kIteration + plan_.cost.application)));
}

template <class Real, class Device>
void DissectedFactorisation<Real, Device>::serialise(Archive& archive, const std::vector<char>& held) {
  SparsityPattern couplings = couplings_;
  archive(couplings.start);
  archive(couplings.item);
  const bool is_other = couplings.start != couplings_.start || couplings.item != couplings_.item;
  if (is_other) take_couplings(std::move(couplings));  // a loaded one
  pairs_.serialise(archive);
  const BlockRowsView<Real> rows = matrix_.view();
  hysteron::serialise(archive, device_, rows.off_diagonal, matrix_.col().size());
  hysteron::serialise(archive, device_, rows.diagonal, rows.rows);
  if (archive.loads()) factorise(Buffer<char, Device>(device_, held).data());
}

template <class Real, class Device>
std::size_t DissectedFactorisation<Real, Device>::bytes() const {
  std::size_t sum =
      definite_->bytes() + matrix_.bytes() + pairs_.bytes() +
      total_bytes(number_, scratch_, scale_, source_, child_row_, term_, child_, block_, ones_, b_);
  for (const Level& level : level_) sum += level.bytes();
  return sum;
}

template class DissectedFactorisation<double, ThisDevice>;
template class DissectedFactorisation<float, ThisDevice>;

}  // namespace hysteron
