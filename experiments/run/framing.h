// What the pictures of any scene frame: all that its cloth passes through.
#pragma once

#include <optional>
#include <string>

#include "experiments/workbench/app/experiment.h"
#include "render/camera.h"

namespace hysteron::experiments {

struct Framing {
  render::Box box;        // [m]
  int triangles = 0;      // of the run that it was found by
  std::string stopped{};  // why that run ended early; empty: it did not
};

// Simulates the scene on a coarse mesh, or on its own where that is a file, and frames what its cloth passes
// through at the instants of pictures.  Throws what make_cloth() and make_simulation() do.
Framing framing_of(const Setup& setup);
// Of the run that a line asks for; nothing where it draws no pictures or says itself what they frame.
std::optional<Framing> framing_of_run(const CommandLine& line);

}  // namespace hysteron::experiments
