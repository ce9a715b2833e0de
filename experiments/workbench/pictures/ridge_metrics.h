// Measures the wrinkles of a crumpled sheet: lengths and heights of its ridges, shares of its area by
// curvature.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// Returns per element the norm of its curvature [1/m], which has `dimension` components each (in a face: xx,
// yy, sqrt2 xy).
std::vector<double> curvature_size(const std::vector<double>& curvature, int dimension);

// Returns the rest shape of a tube as it was cut, in a plane [m], with x along the tube.
std::vector<Eigen::Vector2d> unrolled_tube(const ClothMesh& mesh, const ClothShape& shape);

// Returns the length of all ridges [m]: half the outline, on the cloth at rest, of the places where `value`
// (per vertex, linear in between) exceeds `threshold`.  By Cauchy's and Crofton's formula that is what
// Underwood (1970) measures with test lines, pi/2 times the area times the number of ridges that they cross
// per length, in the limit of arbitrarily dense lines of every direction: it depends on no grid and no
// orientation of the mesh, and needs no plane.  A straight ridge is found too long by its own width.
double ridge_length(const ClothMesh& mesh, const std::vector<float>& value, double threshold);
// Returns the same for a part of the cloth, its faces: half of the outline that lies in it.  The border of
// the part is no outline, so that parts add up to the whole.
double ridge_length(const ClothMesh& mesh, const std::vector<float>& value, double threshold,
                    const std::vector<int>& faces);

// Returns the height of the ridges at these vertices from valley to crest [m], for cloth at positions `x`
// [m]: the distance of the cloth from its own mean surface along that surface's normal, from the 5th to the
// 95th percentile by area.  The mean is Gaussian, weighted by area, around each vertex on the cloth at rest
// (ISO 16610-61): of straight ripples of wavelength w it passes 2^-(cutoff/w)^2, half at w = cutoff, so that
// longer shapes are no ridges.  It reaches as far as neighbours of neighbours lie within 0.6 cutoff of the
// vertex, and never into another piece of cloth.  A sine of amplitude A has the height 2 A sin(0.45 pi) (1 -
// 2^-(cutoff/w)^2).
double ridge_height(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x,
                    const std::vector<int>& vertices, double cutoff);

// Returns the share of the area per bin of width `bin` from 0 on; the last bin includes larger values.
std::vector<double> area_fractions(const std::vector<double>& value, const std::vector<double>& area,
                                   double bin, int bins);

}  // namespace hysteron::experiments
