// The direction of the key light, the one that gives a picture its shadows.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "render/camera.h"
#include "render/look.h"

namespace hysteron::render {

// Returns the unit normal of the plane that lies nearest to the points, given as x, y, z each.
Eigen::Vector3f plane_normal(std::span<const float> xyz);

// Returns the direction to a look's key light, of any length: the look's own, else from the left of the
// picture. A raking light grazes the cloth, whose plane has the given normal (none: the picture's plane).
Eigen::Vector3f key_direction(const Look& look, const Camera& camera,
                              const std::optional<Eigen::Vector3f>& cloth_normal);

}  // namespace hysteron::render
