// Gathers forces of elements on their vertices in a fixed order.
#pragma once

#include <Eigen/Core>
#include <span>

#include "sim/device/device.h"

namespace hysteron {

template <class Real>
struct GatheredForces {
  const int* start = nullptr;         // n + 1 row starts, one row per vertex; null: no elements
  const int* item = nullptr;          // indices of forces: 4 * element + corner
  const Vec3<Real>* force = nullptr;  // elements x 4 [N]
  HYST_HD Vec3<Real> at(int vertex) const {
    Vec3<Real> f = Vec3<Real>::Zero();
    for (int j = start[vertex]; j < start[vertex + 1]; ++j) f += force[item[j]];
    return f;
  }
};

// A stiffness that products apply element by element, in single precision.
template <class Device>
class FloatStiffness {
 public:
  virtual ~FloatStiffness() = default;
  // Rounds the stiffness as it was linearised last.
  virtual void round() = 0;
  // Returns the product with a displacement (n vertices), like the StiffnessProduct of double precision.
  virtual GatheredForces<float> apply(const Vec3<float>* p) = 0;
  virtual std::size_t force_bytes() const = 0;  // bytes of the result of apply()
  virtual std::size_t bytes() const = 0;
};

// Sets to[i] = from[i] for i in [0, count).
template <class Device>
void round_all(Device& device, const char* name, std::size_t count, const double* from, float* to) {
  for_each(
      device, {name, count * (sizeof(double) + sizeof(float))}, static_cast<int>(count),
      HYST_KERNEL(int i) { to[i] = static_cast<float>(from[i]); });
}

// A stiffness that products apply element by element, in the parts from which it is assembled.

// The stiffness is the sum over the elements of B^T T B: B is the rate of up to three strains by the
// positions of the element's vertices, T the rate of its forces by the strains.
class ElementStiffness {
 public:
  using Rates = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // B, three columns for each vertex [strain/m]

  virtual ~ElementStiffness() = default;
  virtual int elements() const = 0;
  virtual std::span<const int> vertices(int element) const = 0;
  // Returns B and T where the stiffness was linearised last; rows of strains that an element lacks are zero.
  virtual void linearised(int element, Rates& rates, Eigen::Matrix3d& stiffness) const = 0;
};

}  // namespace hysteron
