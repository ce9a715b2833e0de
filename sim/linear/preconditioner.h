// What conjugate gradients are preconditioned with.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

template <class Real, class Device>
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  // z = P r for the rows that are not held, z = 0 for those that are; P symmetric and positive definite, and
  // the same for all calls within a solve.  r is zero on held rows.
  virtual void apply(const Vec3<Real>* r, Vec3<Real>* z) = 0;
  virtual std::size_t bytes() const = 0;
};

}  // namespace hysteron
