// Rounds the vertices of bodies of triangles to whole multiples of a quantum, as pictures show and keep them,
// like the cloth's.
#pragma once

#include <vector>

#include "render/shapes.h"
#include "sim/scene/body.h"

namespace hysteron::experiments {

// Returns the cloth's quantum [m] in the body's own frame, at the largest scale of its motion.
double body_quantum(const Obstacle& body, double cloth_quantum);
// Returns vertices in the body's own frame at `time` [s], 3 numbers each [m]; quantum 0: unrounded.
std::vector<float> drawn_body(const Obstacle& body, double time, double quantum);
// Returns the surface of these vertices, 3 numbers each [m].
render::TriangleMesh body_surface(const BodyMesh& body, const std::vector<float>& xyz);

}  // namespace hysteron::experiments
