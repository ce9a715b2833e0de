// Cameras as files: what a run was pictured from, for another run or another program.
#pragma once

#include <string>

#include "experiments/workbench/app/options.h"
#include "render/camera.h"

namespace hysteron::experiments {

// JSON: {"camera": {"direction": [x, y, z], "fov": degree, "target": [x, y, z], "distance": m}, "size":
// "1280x720"}; metres, z up.  From the target the eye is `distance` along `direction`; the vertical angle is
// `fov`.
std::string camera_text(const render::Camera& camera, const std::string& size);
// Sets the keys camera.* that the file has.  Throws Error::invalid_input where the file is missing or no such
// JSON, with what is wrong in it.
void read_camera(const std::string& file, Options& options);

}  // namespace hysteron::experiments
