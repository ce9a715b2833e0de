#include "sim/linear/sparse_factorisation.h"

#include <algorithm>

namespace hysteron {

namespace {

// The cost of a number of the factor in an iteration's two triangular solves, in multiplications of a
// factorisation, which run on cached data.
constexpr double kMultiplicationsOfEntry = 12;
constexpr double kAssembly = 1.5;  // least time of a factorisation with assembly over that without
constexpr int kMinRefactorThreshold = 6;

// Presents a system's pairs of layers as elements.
template <class Real>
class PairElements : public ElementStiffness {
 public:
  explicit PairElements(const PairProduct<Real>& pairs) : pairs_(pairs) {}

  int elements() const override { return pairs_.count; }
  std::span<const int> vertices(int pair) const override { return pairs_.pair[pair].v; }
  void linearised(int pair, Rates& rates, Eigen::Matrix3d& stiffness) const override {
    const PairStiffness<Real>& s = pairs_.pair[pair];
    for (int k = 0; k < 4; ++k)
      rates.middleCols<3>(3 * k) = static_cast<double>(s.weight[k]) * Eigen::Matrix3d::Identity();
    stiffness = s.block.template cast<double>();
  }

 private:
  PairProduct<Real> pairs_;
};

}  // namespace

template <class Real>
SparseFactorisation<Real>::SparseFactorisation(Cpu& device, const BlockRows<Real, Cpu>& pattern,
                                               std::unique_ptr<ElementStiffness> bending)
    : device_(device),
      bending_(std::move(bending)),
      pattern_(pattern.pattern()),
      values_(3 * (pattern_.start.size() - 1)) {
  CouplingList list(pattern_);
  if (bending_)
    for (int e = 0; e < bending_->elements(); ++e) list.add(bending_->vertices(e));
  always_ = list.take();
  take_couplings(always_);
}

template <class Real>
void SparseFactorisation<Real>::take_couplings(SparsityPattern couplings) {
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
bool SparseFactorisation<Real>::are_coupled(const PairProduct<Real>& pairs) const {
  for (int p = 0; p < pairs.count; ++p)
    if (!matrix_.couples(pairs.pair[p].v)) return false;
  return true;
}

// Couples the vertices of pairs; pairs that no longer touch stay until others come.
template <class Real>
void SparseFactorisation<Real>::couple(const PairProduct<Real>& pairs) {
  CouplingList list(always_);
  for (int p = 0; p < pairs.count; ++p) list.add(pairs.pair[p].v);
  take_couplings(list.take());
}

template <class Real>
void SparseFactorisation<Real>::assemble(const LinearSystem<Real, Cpu>& system, const char* held) {
  const BlockRowsView<Real>& rows = system.matrix;
  matrix_.set_zero();
  for (int i = 0; i < rows.rows; ++i) {
    matrix_.diagonal[i] = rows.diagonal[i].template cast<double>();
    for (int j = pattern_.start[i]; j < pattern_.start[i + 1]; ++j)
      if (row_slot_[j] >= 0) matrix_.below[row_slot_[j]] = rows.off_diagonal[j].template cast<double>();
  }
  const int* slots = bending_slot_.data();
  if (bending_)
    for (int e = 0; e < bending_->elements(); ++e) slots = matrix_.add(*bending_, e, slots);
  const PairElements<Real> pairs(system.pairs);
  std::vector<int> pair_slots;
  for (int p = 0; p < pairs.elements(); ++p) {
    pair_slots.clear();
    matrix_.find_slots(pairs.vertices(p), pair_slots);
    matrix_.add(pairs, p, pair_slots.data());
  }
  matrix_.hold(held);
}

template <class Real>
void SparseFactorisation<Real>::renew(const LinearSystem<Real, Cpu>& system, const char* held) {
  if (!are_coupled(system.pairs)) couple(system.pairs);
  assemble(system, held);
  factor_->factorise(matrix_);
  held_.assign(held, held + matrix_.nodes());
}

template <class Real>
int SparseFactorisation<Real>::refactor_threshold() const {
  const SymbolicFactorization& plan = factor_->plan();
  return std::max(kMinRefactorThreshold,
                  static_cast<int>(kAssembly * plan.multiplications /
                                   (kMultiplicationsOfEntry * static_cast<double>(plan.entries))));
}

template <class Real>
void SparseFactorisation<Real>::apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) {
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
void SparseFactorisation<Real>::serialise(Archive& archive, const std::vector<char>& held) {
  SparsityPattern couplings = matrix_.couplings();
  archive(couplings.start);
  archive(couplings.item);
  if (archive.loads()) take_couplings(couplings);
  for (auto* blocks : {&matrix_.diagonal, &matrix_.below})
    archive.bytes(blocks->data(), blocks->size() * sizeof(Eigen::Matrix3d));
  if (!archive.loads()) return;
  factor_->factorise(matrix_);
  held_ = held;
}

template <class Real>
std::size_t SparseFactorisation<Real>::bytes() const {
  const std::size_t blocks = matrix_.diagonal.size() + matrix_.below.size();
  return factor_->bytes() + blocks * sizeof(Eigen::Matrix3d) +
         (row_slot_.size() + bending_slot_.size()) * sizeof(int) + values_.size() * sizeof(double);
}

template class SparseFactorisation<double>;
template class SparseFactorisation<float>;

}  // namespace hysteron
