// The outline of a draped specimen, seen from straight above.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron::experiments {

// Radius of the outline around the vertical axis, at equal angles: the outermost crossing of each ray with
// the projected triangles' edges [m].
struct Outline {
  std::vector<double> radius;

  double area() const;  // [m^2]; the outline is star-shaped around the pedestal's axis
  // Counts the folds: maxima of the outline that stand out by more than `prominence` [m] from the minima on
  // both sides.
  int nodes(double prominence) const;
};

Outline outline_from_above(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x, int directions);

// The area that both cover over that which either covers (the Jaccard index), 0 to 1; both are seen around
// the same axis at the same angles.
double overlap(const Outline& a, const Outline& b);

// 100 (A - A_disc)/(A_specimen - A_disc) (Cusick 1968; BS 5058, ISO 9073-9) [%].
double drape_coefficient(double projected_area, double disc_radius, double specimen_radius);
// True if the shadow covers the pedestal and at most the flat specimen, with 1 % for stretch.
inline bool is_drape_coefficient(double percent) { return percent >= 0 && percent <= 101; }

}  // namespace hysteron::experiments
