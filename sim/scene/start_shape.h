// Start shapes of a cloth that is flat at rest: bent, hardly stretched, and clear of itself.
#pragma once

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Returns the length of the shortest strip in which a knot with loops of this radius can be tied, with tails
// as long as a loop's radius [m].
double knot_length(double width, double radius);

// Throws Error::invalid_input for a start that the cloth's shape, its sizes or the number of triangles do not
// allow.
void check_start_shape(const Scene& scene);

// Returns where the vertices of the mesh start [m] before the scene places them: in the rest shape, knot or
// pleats, each copy with its own random turn and offset; or at a file's positions.
//
// knot: its middle line winds twice around z on a torus, a trefoil cut open at its outermost point, and goes
// on straight along -x and +x.  The strip is swept along its binormal, so that its middle line bends about
// its width alone: at a distance v from it and with a torsion tau the strip is stretched by (v tau)^2 / 2
// there, below 1 %. pleats: flat runs along x, one above the other in z, joined by half circles.
std::vector<Eigen::Vector3d> start_shape(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron
