// A run as one binary glTF file, for browsers, Blender and game engines.
#pragma once

#include <cstddef>
#include <string>

#include "experiments/workbench/animation/animated_scene.h"

namespace hysteron::experiments {

// Morph targets that viewers bear: one in a browser has a uniform and a layer of a texture for each, of which
// WebGL 2 promises 256, other uniforms included.
inline constexpr std::size_t kMostMorphTargets = 200;
// A file of this format counts no farther [bytes].
inline constexpr std::size_t kMostGlbBytes = 0xFFFFFFFF;

// Metres, turned as a whole so that y is up: (x, y, z) here is (x, z, -y) there.  A surface that changes its
// shape has its first instant as the base and a morph target of points and normals for each other one, and
// weights that lead linearly from one to the next at the run's own times [s]; rigid bodies have translation,
// rotation and scale at these.  With the pictures' camera.  Appears under its name when it is whole.
// Throws Error::invalid_input beyond kMostGlbBytes, Error::system, and what points_at() does.
void write_glb(const std::string& file, const AnimatedScene& scene);

// An upper bound of the file's size.
std::size_t glb_bytes(const AnimatedScene& scene);

}  // namespace hysteron::experiments
