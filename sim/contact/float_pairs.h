// The stiffness of self-contact in a scene of double precision as a product in single precision.
#pragma once

#include "sim/contact/self_contact.h"
#include "sim/linear/float_stiffness.h"

namespace hysteron {

template <class Device>
class FloatPairs : public FloatStiffness<Device> {
 public:
  // `contact` must outlive it.
  FloatPairs(Device& device, const SelfContact<double, Device>& contact)
      : device_(device), contact_(contact), stiffness_(device), force_(device) {}

  void round() override;
  GatheredForces<float> apply(const Vec3<float>* p) override;
  std::size_t force_bytes() const override { return 0; }  // it differs from system to system
  std::size_t bytes() const override { return stiffness_.bytes() + force_.bytes(); }

 private:
  Device& device_;
  const SelfContact<double, Device>& contact_;
  GrowingBuffer<PairStiffness<float>, Device> stiffness_;
  GrowingBuffer<Vec3<float>, Device> force_;  // four for each pair
};

}  // namespace hysteron
