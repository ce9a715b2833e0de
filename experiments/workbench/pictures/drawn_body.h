// Bodies of triangles as pictures show and keep them: their vertices are whole multiples of a quantum, as the
// cloth's are.
#pragma once

#include <vector>

#include "render/shapes.h"
#include "sim/scene/body.h"

namespace hysteron::experiments {

// That of the cloth [m], at the largest size that the body's motion gives it.
double body_quantum(const Obstacle& body, double cloth_quantum);
// Vertices in the body's own frame at `time` [s], 3 numbers each [m]; quantum 0: as they are.
std::vector<float> drawn_body(const Obstacle& body, double time, double quantum);
// The surface of these vertices.
render::TriangleMesh body_surface(const BodyMesh& body, const std::vector<float>& xyz);

}  // namespace hysteron::experiments
