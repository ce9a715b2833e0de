// A stiffness that products apply element by element, in the parts from which it is assembled.
#pragma once

#include <Eigen/Core>
#include <span>

namespace hysteron {

// Sum over the elements of B^T T B with B: how up to three strains change with the positions of the
// element's vertices, T: how its forces change with the strains.
class ElementStiffness {
 public:
  using Rates = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // B, three columns for each vertex [strain/m]

  virtual ~ElementStiffness() = default;
  virtual int elements() const = 0;
  virtual std::span<const int> vertices(int element) const = 0;
  // B and T where the stiffness was linearised last; rows of strains that an element does not have are zero.
  virtual void linearised(int element, Rates& rates, Eigen::Matrix3d& stiffness) const = 0;
};

}  // namespace hysteron
