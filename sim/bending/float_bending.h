// The bending stiffness of a scene of double precision as a product in single precision.
#pragma once

#include "sim/bending/bending.h"
#include "sim/linear/gathered_forces.h"

namespace hysteron {

template <class Device>
class FloatBending : public FloatStiffness<Device> {
 public:
  // `bending` must outlive it.
  FloatBending(Device& device, const Bending<double, Device>& bending);

  void round() override;
  GatheredForces<float> apply(const Vec3<float>* p) override;
  std::size_t force_bytes() const override;
  std::size_t bytes() const override {
    return bytes_of(coefficient_, transposed_, gradient_, tangent_, rate_, moment_area_, force_);
  }

 private:
  template <int D>
  void apply_moments(const BendingFactors<double>& factors);

  Device& device_;
  const Bending<double, Device>& bending_;
  // As in Bending.
  Buffer<float, Device> coefficient_, transposed_, gradient_, tangent_;
  Buffer<float, Device> rate_, moment_area_;
  Buffer<Vec3<float>, Device> force_;
};

}  // namespace hysteron
