// Curvature at the vertices, as pictures show it, and the weights of means over the cloth.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// The area that each bending element stands for in means over the cloth [m^2]: a face its own, a hinge half
// that of its two faces.
std::vector<double> element_areas(const ClothMesh& mesh, int dimension);

// Root mean square over a cloth, or a part of it, of the curvature of its elements [1/m], `dimension`
// components each, `area` from element_areas(). A hinge sees of a bend what crosses its edge, and |e| h of
// all hinges (curvature_operator.h) is three times the area of the cloth: their squares are summed as their
// energies are, so that it is the curvature of the `shape` element with the same energy.
double curvature_rms(const std::vector<double>& curvature, const std::vector<double>& area, int dimension);

// Average of one number per element over the elements at each vertex, weighted by their areas.  `dimension`:
// of the elements' curvature, 1: hinges, 3: faces.
std::vector<float> vertex_average(const ClothMesh& mesh, const std::vector<double>& element, int dimension);
// A scalar per vertex from the elements' curvature [1/m], `dimension` components each: its trace (the sum of
// both principal curvatures).
std::vector<float> vertex_curvature(const ClothMesh& mesh, const std::vector<double>& element, int dimension);

// The same of a surface whose shape at rest is unknown, taken as flat: the traces of the `shape` element
// (curvature_operator.h) with the lengths that the surface has now.  Unfolding neighbouring faces into a
// plane needs no rest shape, and cloth hardly stretches, so that this is what a run shows of the same
// positions; like there, faces at a free edge carry no curvature across it.  1/R on a cylinder, 2/R on a
// sphere, positive where the front side is concave.  `what` names the surface in messages. Throws
// Error::invalid_input for what build_topology refuses.
std::vector<float> surface_curvature(const std::vector<Eigen::Vector3d>& position,
                                     const std::vector<Eigen::Vector3i>& face, const std::string& what);

}  // namespace hysteron
