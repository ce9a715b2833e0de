// Forms bending's Gauss-Newton stiffness J^T C^T (A dM/dK) C J element by element, on the CPU.
#pragma once

#include "sim/bending/bending.h"
#include "sim/linear/gathered_forces.h"

namespace hysteron {

// Returns a row per element with the vertices of the hinges that its curvature depends on, each once.
// `start` and `hinge` are the operator's rows, `corner` the four vertices of each hinge, all on the host.
Adjacency vertices_of_elements(int elements, const int* start, const int* hinge,
                               const Eigen::Vector4i* corner);

// The stiffness of single elements: an element couples all vertices of the hinges whose angles its curvature
// depends on.
template <class Real>
class BendingElements : public ElementStiffness {
 public:
  // `bending` must outlive it.
  explicit BendingElements(const Bending<Real, Cpu>& bending);

  int elements() const override { return static_cast<int>(vertex_.start.size()) - 1; }
  std::span<const int> vertices(int element) const override {
    const int first = vertex_.start[element];
    return {vertex_.item.data() + first, static_cast<std::size_t>(vertex_.start[element + 1] - first)};
  }
  void linearised(int element, Rates& rates, Eigen::Matrix3d& stiffness) const override;

 private:
  const Bending<Real, Cpu>& bending_;
  Adjacency vertex_;                        // rows: elements
  std::vector<std::array<int, 4>> corner_;  // per item of the operator: its hinge's vertices in the list
};

// Applies the bending stiffness of a scene of double precision in single precision.
template <class Device>
class FloatBending : public FloatStiffness<Device> {
 public:
  // `bending` must outlive it.
  FloatBending(Device& device, const Bending<double, Device>& bending);

  void round() override;
  GatheredForces<float> apply(const Vec3<float>* p) override;
  std::size_t force_bytes() const override;
  std::size_t bytes() const override {
    return total_bytes(coefficient_, transposed_, gradient_, tangent_, rate_, moment_area_, force_);
  }

 private:
  template <int D>
  void apply_moments(const BendingFactors<double>& factors);

  Device& device_;
  const Bending<double, Device>& bending_;
  // Copies of the arrays of Bending.
  Buffer<float, Device> coefficient_, transposed_, gradient_, tangent_;
  Buffer<float, Device> rate_, moment_area_;
  Buffer<Vec3<float>, Device> force_;
};

}  // namespace hysteron
