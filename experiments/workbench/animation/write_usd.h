// A run as one file of Pixar's Universal Scene Description, for usdview, Blender, Houdini and Omniverse.
#pragma once

#include <string>

#include "experiments/workbench/animation/animated_scene.h"

namespace hysteron::experiments {

// The format as text (.usda): metres, z up, a time code for each instant of the rate.  Surfaces that change
// their shape have samples of points, normals and extent; rigid bodies of translation, orientation and scale;
// both are interpolated linearly in between.  With the pictures' camera, key light and sky.  Appears under
// its name when it is whole.  Throws Error::system, and what points_at() does.
void write_usd(const std::string& file, const AnimatedScene& scene);

// Where an instant is among time codes: its time [s] by the rate, or, without a rate, by the 24 that the
// format takes where none is stated.
double time_code(const AnimatedScene& scene, double time);

}  // namespace hysteron::experiments
