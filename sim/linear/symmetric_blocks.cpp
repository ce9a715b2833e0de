#include "sim/linear/symmetric_blocks.h"

#include <algorithm>

#include "sim/linear/compressed_rows.h"

namespace hysteron {

CouplingList::CouplingList(const Couplings& couplings) : below_(couplings.start.size() - 1) {
  for (std::size_t i = 0; i < below_.size(); ++i)
    below_[i].assign(couplings.item.begin() + couplings.start[i],
                     couplings.item.begin() + couplings.start[i + 1]);
}

void CouplingList::add(std::span<const int> nodes) {
  for (int i : nodes)
    for (int j : nodes)
      if (j < i) below_[i].push_back(j);
}

Couplings CouplingList::take() {
  Couplings result = compressed(below_);
  below_.clear();
  return result;
}

SymmetricBlocks::SymmetricBlocks(Couplings couplings)
    : diagonal(couplings.start.size() - 1), below(couplings.item.size()), couplings_(std::move(couplings)) {
  set_zero();
}

int SymmetricBlocks::slot(int i, int j) const {
  const auto first = couplings_.item.begin() + couplings_.start[i],
             last = couplings_.item.begin() + couplings_.start[i + 1], at = std::lower_bound(first, last, j);
  return at != last && *at == j ? static_cast<int>(at - couplings_.item.begin()) : -1;
}

bool SymmetricBlocks::couples(std::span<const int> nodes) const {
  for (int i : nodes)
    for (int j : nodes)
      if (j < i && slot(i, j) < 0) return false;
  return true;
}

void SymmetricBlocks::find_slots(std::span<const int> nodes, std::vector<int>& slots) const {
  for (int i : nodes)
    for (int j : nodes)
      if (j < i) slots.push_back(slot(i, j));
}

void SymmetricBlocks::set_zero() {
  std::fill(diagonal.begin(), diagonal.end(), Eigen::Matrix3d::Zero());
  std::fill(below.begin(), below.end(), Eigen::Matrix3d::Zero());
}

const int* SymmetricBlocks::add(const ElementStiffness& stiffness, int e, const int* slots) {
  const std::span<const int> vertex = stiffness.vertices(e);
  const int n = static_cast<int>(vertex.size());
  Eigen::Matrix3d tangent;
  rates_.resize(3, 3 * n);
  stiffness.linearised(e, rates_, tangent);
  forces_ = tangent.lazyProduct(rates_);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (vertex[b] > vertex[a]) continue;
      Eigen::Matrix3d& block = a == b ? diagonal[vertex[a]] : below[*slots++];
      block += rates_.middleCols<3>(3 * a).transpose().lazyProduct(forces_.middleCols<3>(3 * b));
    }
  return slots;
}

void SymmetricBlocks::hold(const char* held) {
  for (int i = 0; i < nodes(); ++i) {
    if (held[i]) diagonal[i].setIdentity();
    for (int j = couplings_.start[i]; j < couplings_.start[i + 1]; ++j)
      if (held[i] || held[couplings_.item[j]]) below[j].setZero();
  }
}

}  // namespace hysteron
