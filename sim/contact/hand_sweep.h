// Whether hands lead the layers that they hold through each other: vertices that are all held are in no pair
// of self-contact.
#pragma once

#include "sim/contact/self_pairs.h"

namespace hysteron {

template <class Real, class Device>
class HandSweep {
 public:
  HandSweep(Device& device, const ClothMesh& mesh, double thickness)
      : device_(device), pairs_(device, mesh, thickness), share_(device) {}

  // Whether layers that different hands hold stay as far apart as pressure could press them while held
  // vertices go from x along `way` [m], which is 0 of free ones; `hand` is the number of the one at each
  // vertex.
  bool is_free(const Vec3<Real>* x, const Vec3<Real>* way, const char* held, const int* hand);
  std::size_t bytes() const { return pairs_.bytes() + share_.bytes(); }

 private:
  Device& device_;
  SelfPairs<Real, Device> pairs_;
  GrowingBuffer<Real, Device> share_;  // of its way that each pair may go
};

}  // namespace hysteron
