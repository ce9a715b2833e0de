// Reads and writes a run's camera as a file for another run or another program.
#pragma once

#include <string>

#include "experiments/workbench/app/options.h"
#include "render/camera.h"

namespace hysteron::experiments {

// Returns the JSON {"camera": {"direction": [x, y, z], "fov": degree, "target": [x, y, z], "distance": m},
// "size": "1280x720"} in metres, z up.  The eye is `distance` from the target along `direction`; the vertical
// angle is `fov`.
std::string camera_text(const render::Camera& camera, const std::string& size);
// Sets the keys camera.* that the file has.  Throws Error::invalid_input, saying what is wrong, if the file
// is missing or no such JSON.
void read_camera(const std::string& file, Options& options);

}  // namespace hysteron::experiments
