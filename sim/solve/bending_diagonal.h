// Diagonal blocks of the bending stiffness for preconditioners, from the hinges alone.
#pragma once

#include "sim/device/device.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// sum over hinges of rigidity |e|/h g g^T, g the gradient of the hinge's angle at the vertex (Wong et al.
// 2013, Eq. 4.1, linearised): as many conjugate gradient iterations as with the blocks of the `shape`
// element, whose rows reach a ring farther.
template <class Real, class Device>
class BendingDiagonal {
 public:
  BendingDiagonal(Device& device, const ClothMesh& mesh);

  // rigidity in the units of the matrix: step^2 b1 for mass + step^2 stiffness.
  void update(const Vec3<Real>* position, Real rigidity);
  const Mat3<Real>* data() const { return block_.data(); }
  std::size_t bytes() const;

 private:
  Device& device_;
  Buffer<Eigen::Vector4i, Device> corner_;  // p0, p1, p2, p3 of each hinge
  Buffer<Real, Device> aspect_;             // |e|/h
  Buffer<int, Device> start_, item_;        // rows: vertices; items: 4*hinge + slot
  Buffer<Mat3<Real>, Device> block_;
};

}  // namespace hysteron
