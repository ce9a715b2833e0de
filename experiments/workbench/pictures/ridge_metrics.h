// What a crumpled sheet keeps: lengths of its ridges, shares of its area by curvature.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// Per element the norm of its curvature [1/m]; `dimension` components each (in a face: xx, yy, sqrt2 xy).
std::vector<double> curvature_size(const std::vector<double>& curvature, int dimension);

// The rest shape of a tube as it was cut, in a plane [m]: x along the tube.
std::vector<Eigen::Vector2d> unrolled_tube(const ClothMesh& mesh, const ClothShape& shape);

// Length of all ridges [m]: half the outline, on the cloth at rest, of the places where `value` (per vertex,
// linear in between) exceeds `threshold`.  By Cauchy's and Crofton's formula that is what Underwood (1970)
// measures with test lines, pi/2 times the area times the number of ridges that they cross per length, in the
// limit of lines of every direction as close as one likes: it depends on no grid and no orientation of the
// mesh, and needs no plane.  A straight ridge is found too long by its own width.
double ridge_length(const ClothMesh& mesh, const std::vector<float>& value, double threshold);

// Share of the area per bin of width `bin` from 0 on; values beyond the last bin are in it.
std::vector<double> area_fractions(const std::vector<double>& value, const std::vector<double>& area,
                                   double bin, int bins);

}  // namespace hysteron::experiments
