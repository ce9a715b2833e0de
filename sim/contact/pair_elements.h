// The stiffness of self-contact as elements of a matrix.
#pragma once

#include "sim/contact/self_contact.h"
#include "sim/linear/gathered_forces.h"

namespace hysteron {

// The stiffness of self-contact pair by pair, on the host: between the closest points of each.
template <class Real, class Device>
class PairElements : public ElementStiffness {
 public:
  // `contact` must outlive it.
  PairElements(Device& device, const SelfContact<Real, Device>& contact)
      : device_(device), contact_(contact) {}

  void refresh() override {
    const auto pressing = contact_.pressing();
    pair_ = downloaded(device_, pressing.data(), pressing.size());
  }
  int elements() const override { return static_cast<int>(pair_.size()); }
  std::span<const int> vertices(int pair) const override { return pair_[pair].v; }
  void linearised(int pair, Rates& rates, Eigen::Matrix3d& stiffness) const override {
    const PairStiffness<Real>& s = pair_[pair];
    for (int k = 0; k < 4; ++k)
      rates.middleCols<3>(3 * k) = static_cast<double>(s.weight[k]) * Eigen::Matrix3d::Identity();
    stiffness = s.block.template cast<double>();
  }

 private:
  Device& device_;
  const SelfContact<Real, Device>& contact_;
  std::vector<PairStiffness<Real>> pair_;
};

}  // namespace hysteron
