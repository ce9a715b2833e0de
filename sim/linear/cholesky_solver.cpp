#include "sim/linear/cholesky_solver.h"

#include <algorithm>
#include <cmath>

namespace hysteron {

namespace {

constexpr double kVanished = 1e-14;  // pivot over the matrix's diagonal number; what rounding leaves
constexpr int kTileRows = 12, kTileColumns = 4;
constexpr int kPanelColumns = 12;  // that are eliminated before the next ones are updated

// A dense matrix by columns, of which the lower triangle counts.
struct Dense {
  double* at;
  std::ptrdiff_t stride;
  double* column(int j) const { return at + j * stride; }
};

// c -= a b^T of Rows x Columns numbers, with `depth` columns of a and b, whose strides are the same.
template <int Rows, int Columns>
void subtract_tile(Dense c, const double* a, const double* b, int depth, std::ptrdiff_t stride) {
  using Column = Eigen::Matrix<double, Rows, 1>;
  Eigen::Matrix<double, Rows, Columns> sum = Eigen::Matrix<double, Rows, Columns>::Zero();
  for (int k = 0; k < depth; ++k) {
    const Column column = Eigen::Map<const Column>(a + k * stride);
    for (int j = 0; j < Columns; ++j) sum.col(j) += b[k * stride + j] * column;
  }
  for (int j = 0; j < Columns; ++j) Eigen::Map<Column>(c.column(j)) -= sum.col(j);
}

// The first `columns` columns of c's lower part, `rows` long, lose a a^T; a has `depth` columns.
void subtract_square(Dense c, Dense a, int rows, int columns, int depth) {
  for (int j = 0; j < columns; j += kTileColumns) {
    const int width = std::min(kTileColumns, columns - j);
    int i = j;
    const auto part = [&](int from) { return Dense{c.column(j) + from, c.stride}; };
    if (width == kTileColumns) {
      for (; i + kTileRows <= rows; i += kTileRows)
        subtract_tile<kTileRows, kTileColumns>(part(i), a.at + i, a.at + j, depth, a.stride);
      for (; i + kTileColumns <= rows; i += kTileColumns)
        subtract_tile<kTileColumns, kTileColumns>(part(i), a.at + i, a.at + j, depth, a.stride);
    }
    for (; i < rows; ++i)
      for (int l = 0; l < width; ++l)
        subtract_tile<1, 1>({c.column(j + l) + i, 1}, a.at + i, a.at + j + l, depth, a.stride);
  }
}

// Eliminates the first `pivots` columns of a dense lower trapezoid; returns how many pivots were replaced.
int eliminate(Dense a, int rows, int pivots, const double* least_pivot) {
  int replaced = 0;
  for (int j = 0; j < pivots; j += kPanelColumns) {
    const int end = std::min(j + kPanelColumns, pivots);
    subtract_square({a.column(j) + j, a.stride}, {a.at + j, a.stride}, rows - j, end - j, j);
    for (int k = j; k < end; ++k) {
      double* column = a.column(k);
      if (!(column[k] > least_pivot[k])) {
        column[k] = least_pivot[k] / kVanished;
        ++replaced;
      }
      column[k] = std::sqrt(column[k]);
      const double inverse = 1 / column[k];
      for (int i = k + 1; i < rows; ++i) column[i] *= inverse;
      for (int l = k + 1; l < end; ++l) {
        double* later = a.column(l);
        const double factor = column[l];
        for (int i = l; i < rows; ++i) later[i] -= factor * column[i];
      }
    }
  }
  return replaced;
}

}  // namespace

SparseCholesky::SparseCholesky(const Couplings& couplings)
    : plan_(plan_elimination(couplings)),
      factor_(plan_.entries),
      updates_(plan_.stack),
      least_pivot_(3 * plan_.order.size()),
      ordered_(3 * plan_.order.size()),
      front_(3 * plan_.order.size()) {}

std::size_t SparseCholesky::bytes() const {
  const std::size_t numbers =
      factor_.size() + updates_.size() + least_pivot_.size() + ordered_.size() + front_.size();
  return numbers * sizeof(double) + plan_.front.size() * sizeof(Front) +
         plan_.block.size() * sizeof(EnteringBlock) +
         (plan_.order.size() + plan_.row.size() + plan_.place.size()) * sizeof(int);
}

void SparseCholesky::assemble(const Front& front, const SymmetricBlocks& matrix, double* panel) const {
  const std::ptrdiff_t stride = 3 * front.rows;
  for (int b = front.block_start; b < front.block_end; ++b) {
    const EnteringBlock& entering = plan_.block[b];
    const Eigen::Matrix3d& block = entering.source < 0
                                       ? matrix.diagonal[plan_.order[front.first + entering.column]]
                                       : matrix.below[entering.source];
    Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>> to(
        panel + 3 * entering.column * stride + 3 * entering.row, Eigen::OuterStride<>(stride));
    if (entering.transposed)
      to = block.transpose();
    else
      to = block;
  }
}

// Adds the child's update to the front's own columns and to the rest.
void SparseCholesky::take_over(const Front& child, const Front& front, const double* update, double* panel,
                               double* remainder) const {
  const int* place = plan_.place.data() + child.place_start;
  const std::ptrdiff_t own_stride = 3 * front.rows, rest_stride = 3 * front.updated(),
                       stride = 3 * child.updated();
  for (int j = 0; j < child.updated(); ++j) {
    const bool is_own = place[j] < front.pivots;
    const int below = is_own ? 0 : front.pivots;
    for (int k = 0; k < 3; ++k) {
      const double* from = update + (3 * j + k) * stride;
      double* to = is_own ? panel + (3 * place[j] + k) * own_stride
                          : remainder + (3 * (place[j] - front.pivots) + k) * rest_stride;
      for (int i = j; i < child.updated(); ++i)
        for (int l = 0; l < 3; ++l) to[3 * (place[i] - below) + l] += from[3 * i + l];
    }
  }
}

int SparseCholesky::factorise(const SymmetricBlocks& matrix) {
  for (std::size_t k = 0; k < plan_.order.size(); ++k)
    for (int c = 0; c < 3; ++c) least_pivot_[3 * k + c] = kVanished * matrix.diagonal[plan_.order[k]](c, c);
  struct Waiting {
    const Front* front;
    double* update;
  };
  std::vector<Waiting> waiting;
  double* free = updates_.data();
  int replaced = 0;
  std::fill(factor_.begin(), factor_.end(), 0.0);
  for (const Front& front : plan_.front) {
    const int rows = 3 * front.rows, pivots = 3 * front.pivots, updated = rows - pivots;
    const std::size_t size = static_cast<std::size_t>(updated) * updated;
    double *panel = factor_.data() + front.panel, *remainder = free;
    assemble(front, matrix, panel);
    std::fill(remainder, remainder + size, 0.0);
    const std::size_t others = waiting.size() - front.children;
    for (std::size_t w = others; w < waiting.size(); ++w)
      take_over(*waiting[w].front, front, waiting[w].update, panel, remainder);
    replaced += eliminate({panel, rows}, rows, pivots, least_pivot_.data() + 3 * front.first);
    subtract_square({remainder, updated}, {panel + pivots, rows}, updated, updated, pivots);
    if (front.children > 0) {
      free = waiting[others].update;
      std::copy(remainder, remainder + size, free);
      waiting.resize(others);
    }
    if (updated == 0) continue;
    waiting.push_back({&front, free});
    free += size;
  }
  return replaced;
}

void SparseCholesky::solve(double* x) const {
  const int nodes = static_cast<int>(plan_.order.size());
  double *y = ordered_.data(), *later = front_.data();
  const auto node = [](double* values, int k) { return Eigen::Map<Eigen::Vector3d>(values + 3 * k); };
  for (int k = 0; k < nodes; ++k) node(y, k) = node(x, plan_.order[k]);
  for (const Front& front : plan_.front) {
    const int* row = plan_.row.data() + front.row_start + front.pivots;
    const int rows = 3 * front.rows, pivots = 3 * front.pivots;
    double* own = y + 3 * front.first;
    std::fill(later, later + rows - pivots, 0.0);
    for (int k = 0; k < pivots; ++k) {
      const double* column = factor_.data() + front.panel + static_cast<std::size_t>(k) * rows;
      const double value = own[k] /= column[k];
      for (int i = k + 1; i < pivots; ++i) own[i] -= value * column[i];
      for (int i = pivots; i < rows; ++i) later[i - pivots] += value * column[i];
    }
    for (int r = 0; r < front.updated(); ++r) node(y, row[r]) -= node(later, r);
  }
  for (auto front = plan_.front.rbegin(); front != plan_.front.rend(); ++front) {
    const int* row = plan_.row.data() + front->row_start + front->pivots;
    const int rows = 3 * front->rows, pivots = 3 * front->pivots;
    double* own = y + 3 * front->first;
    for (int r = 0; r < front->updated(); ++r) node(later, r) = node(y, row[r]);
    for (int k = pivots - 1; k >= 0; --k) {
      const double* column = factor_.data() + front->panel + static_cast<std::size_t>(k) * rows;
      using Values = Eigen::Map<const Eigen::VectorXd>;
      double sum = own[k] - Values(column + pivots, rows - pivots).dot(Values(later, rows - pivots));
      for (int i = k + 1; i < pivots; ++i) sum -= column[i] * own[i];
      own[k] = sum / column[k];
    }
  }
  for (int k = 0; k < nodes; ++k) node(x, plan_.order[k]) = node(y, k);
}

namespace {

constexpr int kMaxIterations = 20000;
constexpr int kWithNew = 2;  // iterations that a new factorisation takes, too
// What a number of the factor costs in an iteration's two triangular solves, in multiplications of a
// factorisation, which work on what is in the cache.
constexpr double kMultiplicationsOfEntry = 12;
constexpr double kAssembly = 1.5;  // factorisation with assembly over without, at least
constexpr int kMinWorth = 6;

}  // namespace

template <class Real>
CholeskySolver<Real>::CholeskySolver(Cpu& device, const BlockRows<Real, Cpu>& pattern,
                                     std::unique_ptr<ElementStiffness> bending,
                                     std::unique_ptr<ElementStiffness> self_contact)
    : device_(device),
      pcg_(device, static_cast<int>(pattern.row_ptr().size()) - 1),
      bending_(std::move(bending)),
      self_contact_(std::move(self_contact)),
      pattern_(pattern.pattern()),
      values_(3 * (pattern_.start.size() - 1)) {
  CouplingList list(pattern_);
  if (bending_)
    for (int e = 0; e < bending_->elements(); ++e) list.add(bending_->vertices(e));
  always_ = list.take();
  take_couplings(always_);
}

template <class Real>
void CholeskySolver<Real>::take_couplings(Couplings couplings) {
  matrix_ = SymmetricBlocks(std::move(couplings));
  factor_.emplace(matrix_.couplings());
  row_slot_.clear();
  bending_slot_.clear();
  for (int i = 0; i < matrix_.nodes(); ++i)
    for (int j = pattern_.start[i]; j < pattern_.start[i + 1]; ++j)
      row_slot_.push_back(pattern_.item[j] < i ? matrix_.slot(i, pattern_.item[j]) : -1);
  if (bending_)
    for (int e = 0; e < bending_->elements(); ++e) matrix_.find_slots(bending_->vertices(e), bending_slot_);
}

template <class Real>
bool CholeskySolver<Real>::contact_is_coupled() const {
  for (int pair = 0; pair < self_contact_->elements(); ++pair)
    if (!matrix_.couples(self_contact_->vertices(pair))) return false;
  return true;
}

// Pairs that no longer press stay until others come.
template <class Real>
void CholeskySolver<Real>::couple_contact() {
  CouplingList list(always_);
  for (int pair = 0; pair < self_contact_->elements(); ++pair) list.add(self_contact_->vertices(pair));
  take_couplings(list.take());
}

template <class Real>
void CholeskySolver<Real>::assemble(const BlockRowsView<Real>& rows, const char* held) {
  matrix_.set_zero();
  for (int i = 0; i < rows.rows; ++i) {
    matrix_.diagonal[i] = rows.diagonal[i].template cast<double>();
    for (int j = pattern_.start[i]; j < pattern_.start[i + 1]; ++j)
      if (row_slot_[j] >= 0) matrix_.below[row_slot_[j]] = rows.off_diagonal[j].template cast<double>();
  }
  const int* slots = bending_slot_.data();
  if (bending_)
    for (int e = 0; e < bending_->elements(); ++e) slots = matrix_.add(*bending_, e, slots);
  std::vector<int> pair_slots;
  for (int pair = 0; self_contact_ && pair < self_contact_->elements(); ++pair) {
    pair_slots.clear();
    matrix_.find_slots(self_contact_->vertices(pair), pair_slots);
    matrix_.add(*self_contact_, pair, pair_slots.data());
  }
  matrix_.hold(held);
}

template <class Real>
void CholeskySolver<Real>::renew(const System& system, const char* held) {
  if (self_contact_ && !contact_is_coupled()) couple_contact();
  assemble(system.matrix, held);
  factor_->factorise(matrix_);
  held_.assign(held, held + matrix_.nodes());
  spent_ = 0;
  ++factorisations_;
}

// Iterations that cost as much as a new factorisation.
template <class Real>
int CholeskySolver<Real>::worth() const {
  const Elimination& plan = factor_->plan();
  return std::max(kMinWorth, static_cast<int>(kAssembly * plan.multiplications /
                                              (kMultiplicationsOfEntry * static_cast<double>(plan.entries))));
}

template <class Real>
PcgOutcome CholeskySolver<Real>::solve(const System& system, const char* held, const Vec3<Real>* rhs,
                                       Vec3<Real>* x, double tolerance) {
  System preconditioned = system;
  preconditioned.preconditioner = this;
  const auto attempt = [&](int most) {
    return pcg_.solve(preconditioned, held, rhs, nullptr, nullptr, x, {tolerance, most});
  };
  int before = 0;
  if (!held_.empty() && std::equal(held_.begin(), held_.end(), held) && spent_ < worth()) {
    const PcgOutcome outcome = attempt(worth());
    spent_ += std::max(0, outcome.iterations - kWithNew);
    if (outcome.converged || outcome.iterations < worth()) return outcome;
    before = outcome.iterations;
  }
  renew(system, held);
  const PcgOutcome outcome = attempt(kMaxIterations);
  return {before + outcome.iterations, outcome.converged};
}

template <class Real>
void CholeskySolver<Real>::apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) {
  if (scalars && scalars->done) return;
  for (int i = 0; i < matrix_.nodes(); ++i)
    for (int k = 0; k < 3; ++k) values_[3 * i + k] = static_cast<double>(r[i][k]);
  factor_->solve(values_.data());
  for (int i = 0; i < matrix_.nodes(); ++i)
    for (int k = 0; k < 3; ++k) z[i][k] = held_[i] ? Real(0) : static_cast<Real>(values_[3 * i + k]);
  if (!scalars) return;
  for_each_sum<1>(
      device_, "solve: weigh", matrix_.nodes(),
      [r, z](int i, Sums<1>& sums) { sums.term[0] += static_cast<double>(r[i].dot(z[i])); },
      [scalars](const Sums<1>& total) { scalars->advance(total.term[0]); });
}

template <class Real>
void CholeskySolver<Real>::serialise(Archive& archive) {
  pcg_.serialise(archive);
  archive(spent_);
  archive(held_);
  if (held_.empty()) return;
  Couplings couplings = matrix_.couplings();
  archive(couplings.start);
  archive(couplings.item);
  if (archive.loads()) take_couplings(couplings);
  for (auto* blocks : {&matrix_.diagonal, &matrix_.below})
    archive.bytes(blocks->data(), blocks->size() * sizeof(Eigen::Matrix3d));
  if (archive.loads()) factor_->factorise(matrix_);
}

template <class Real>
std::size_t CholeskySolver<Real>::bytes() const {
  const std::size_t blocks = matrix_.diagonal.size() + matrix_.below.size();
  return pcg_.bytes() + factor_->bytes() + blocks * sizeof(Eigen::Matrix3d) +
         (row_slot_.size() + bending_slot_.size()) * sizeof(int) + values_.size() * sizeof(double);
}

template class CholeskySolver<double>;
template class CholeskySolver<float>;

}  // namespace hysteron
