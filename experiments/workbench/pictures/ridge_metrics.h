// What a crumpled sheet keeps: lengths of its ridges, shares of its area by curvature.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// Per element the norm of its curvature [1/m]; `dimension` components each (in a face: xx, yy, sqrt2 xy).
std::vector<double> curvature_size(const std::vector<double>& curvature, int dimension);

// Rest shape as it was cut, in a plane [m]: x along the cloth's length; tubes are unrolled.
std::vector<Eigen::Vector2d> unrolled(const ClothMesh& mesh, const ClothShape& shape);

// Length of all ridges [m], places where `value` (per vertex) exceeds `threshold`: pi/2 times the area times
// the number of ridges that test lines cross per length (Underwood 1970), lines `spacing` [m] apart along x
// and along y.  Exact in the mean over all directions; a single straight ridge is found up to 21 % too short
// or 11 % too long.  Triangles longer than a quarter of the sheet (a tube's seam, unrolled) are left out.
double ridge_length(const ClothMesh& mesh, const std::vector<Eigen::Vector2d>& at,
                    const std::vector<float>& value, double threshold, double spacing);

// Share of the area per bin of width `bin` from 0 on; values beyond the last bin are in it.
std::vector<double> area_fractions(const std::vector<double>& value, const std::vector<double>& area,
                                   double bin, int bins);

}  // namespace hysteron::experiments
