// How far triangles tilt along the folds of their cloth, which is what sharp folds cost.
#pragma once

#include <vector>

#include "sim/bending/curvature_operator.h"

namespace hysteron {

// A triangle whose corners lie on a cylinder is tilted along the cylinder's axis by
//
//     kappa |(d.e0) (d.e1) (d.e2)| / (4 A),
//
// where d is the direction that is curved by kappa and e0 to e2 are the sides: not at all if one of them lies
// along the axis.  Bending of corners that are held there is too soft by two thirds of the mean square of
// that tilt; free cloth strains instead and is too stiff.  Derived here; the test SharpFolds compares it with
// measured energies.
class FacetTilt {
 public:
  explicit FacetTilt(const ClothMesh& mesh);
  // Returns the tilt of every triangle [rad], >= 0, where all hinges are `bent` by these angles from rest
  // [rad], each from the larger of its principal curvatures.
  std::vector<double> tilts(const std::vector<double>& bent) const;

 private:
  CurvatureOperator shape_;                           // a tensor for each triangle
  std::vector<std::array<Eigen::Vector2d, 3>> side_;  // along the triangle's warp and weft [m]
};

}  // namespace hysteron
