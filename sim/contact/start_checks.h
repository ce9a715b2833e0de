// Checks that contact can go on from a start.
#pragma once

#include "sim/scene/cloth.h"

namespace hysteron {

// Error::invalid_input, which names triangles, vertices, obstacles and distances, if
// - with `self-contact` the cloth is thicker than its diagonal is long, passes through itself, or has parts
//   that are not held throughout as near as no step may bring them (least_distance(), self_touch.h): no way
//   would be free;
// - a triangle that is not held throughout starts across the surface of a body of triangles (scene/body.h),
// or a part
//   of the cloth with one inside a closed body whose triangles face outward;
// - a vertex that no pin holds starts deeper than the cloth's thickness in an obstacle (`hollow`: outside).
// Only vertices are looked at against obstacles: one that is small enough to stand between the vertices of a
// triangle is not refused.
void check_start(const Scene& scene, const Cloth& cloth);

}  // namespace hysteron
