// Computes curvature at the vertices, as pictures show it, and the weights of means over the cloth.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Returns the area that each bending element stands for in means over the cloth [m^2]: a face its own, a
// hinge half that of its two faces.
std::vector<double> element_areas(const ClothMesh& mesh, int dimension);

// Returns the root mean square over a cloth, or a part of it, of the curvature of its elements [1/m],
// `dimension` components each; `area` is from element_areas().  A hinge sees only the bend across its edge,
// and |e| h of all hinges (curvature_operator.h) sums to three times the area of the cloth: their squares are
// summed as their energies are, so that the result is the curvature of the `shape` element with the same
// energy.
double curvature_rms(const std::vector<double>& curvature, const std::vector<double>& area, int dimension);

// Returns at each vertex the average of one number per element, weighted by the elements' areas.  `dimension`
// tells the elements: 1 for hinges, 3 for faces.
std::vector<float> vertex_average(const ClothMesh& mesh, const std::vector<double>& element, int dimension);
// Returns a scalar per vertex from the elements' curvature [1/m], `dimension` components each: its trace (the
// sum of both principal curvatures).
std::vector<float> vertex_curvature(const ClothMesh& mesh, const std::vector<double>& element, int dimension);

// Returns the same for a surface whose rest shape is unknown and taken as flat: the traces of the `shape`
// element (curvature_operator.h) with the lengths that the surface has now.  Unfolding neighbouring faces
// into a plane needs no rest shape, and cloth hardly stretches, so that a run shows the same for these
// positions; like there, faces at a free edge carry no curvature across it.  It is 1/R on a cylinder, 2/R on
// a sphere, positive where the front side is concave.  `what` names the surface in messages.  Throws
// Error::invalid_input for surfaces that build_topology refuses.
std::vector<float> surface_curvature(const std::vector<Eigen::Vector3d>& position,
                                     const std::vector<Eigen::Vector3i>& face, const std::string& what);

}  // namespace hysteron
