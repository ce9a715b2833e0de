// Writes a run as one binary glTF file, for browsers, Blender and game engines.
#pragma once

#include <cstddef>
#include <string>

#include "experiments/workbench/animation/animated_scene.h"

namespace hysteron::experiments {

// Largest number of morph targets in viewers: one in a browser has a uniform and a layer of a texture for
// each, of which WebGL 2 promises 256, other uniforms included.
inline constexpr std::size_t kMostMorphTargets = 200;
// Largest size that the format can state [bytes].
inline constexpr std::size_t kMostGlbBytes = 0xFFFFFFFF;

// Writes the file in metres, rotated so that y is up: (x, y, z) here is (x, z, -y) there.  A surface that
// changes its shape has its first instant as the base, a morph target of points and normals for each other
// one, and weights that blend linearly from one to the next at the run's own times [s]; rigid bodies have
// translation, rotation and scale at these.  The pictures' camera is included.  The file appears under its
// name when it is complete.  Throws Error::invalid_input beyond kMostGlbBytes, Error::system, and what
// points_at() throws.
void write_glb(const std::string& file, const AnimatedScene& scene);

// Returns an upper bound of the file's size [bytes].
std::size_t glb_bytes(const AnimatedScene& scene);

}  // namespace hysteron::experiments
