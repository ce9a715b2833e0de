// Writes a run as one file of Pixar's Universal Scene Description, for usdview, Blender, Houdini and
// Omniverse.
#pragma once

#include <string>

#include "experiments/workbench/animation/animated_scene.h"

namespace hysteron::experiments {

// Writes the text format (.usda) in metres, z up, with a time code for each instant of the rate.  Surfaces
// that change their shape have samples of points, normals and extent; rigid bodies of translation,
// orientation and scale; both are interpolated linearly in between.  The pictures' camera, key light and sky
// are included.  The file appears under its name when it is complete.  Throws Error::system, and what
// points_at() throws.
void write_usd(const std::string& file, const AnimatedScene& scene);

// Returns the time code of a time [s] by the scene's rate or, without a rate, by the 24 per second that the
// format assumes.
double time_code(const AnimatedScene& scene, double time);

}  // namespace hysteron::experiments
