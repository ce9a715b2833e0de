// The stiffness of self-contact as elements of a matrix.
#pragma once

#include "sim/contact/self_contact.h"
#include "sim/linear/gathered_forces.h"

namespace hysteron {

// The stiffness of self-contact pair by pair, on the CPU: between the closest points of each.
template <class Real>
class PairElements : public ElementStiffness {
 public:
  // `contact` must outlive it.
  explicit PairElements(const SelfContact<Real, Cpu>& contact) : contact_(contact) {}

  int elements() const override { return contact_.product().count; }
  std::span<const int> vertices(int pair) const override { return contact_.product().pair[pair].v; }
  void linearised(int pair, Rates& rates, Eigen::Matrix3d& stiffness) const override {
    const PairStiffness<Real>& s = contact_.product().pair[pair];
    for (int k = 0; k < 4; ++k)
      rates.middleCols<3>(3 * k) = static_cast<double>(s.weight[k]) * Eigen::Matrix3d::Identity();
    stiffness = s.block.template cast<double>();
  }

 private:
  const SelfContact<Real, Cpu>& contact_;
};

}  // namespace hysteron
