// Finds what pictures frame if the scene alone determines where its cloth goes: all that the cloth passes
// through.
#pragma once

#include <optional>
#include <string>

#include "experiments/workbench/app/experiment.h"
#include "render/camera.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct Framing {
  render::Box box;        // [m]
  int triangles = 0;      // number of triangles of the trial
  std::string stopped{};  // why the trial ended early; empty if it did not
};

// Simulates the scene on a coarse mesh, or on its own if that is a file.  The result frames `known`, which
// the cloth is expected to pass through, and if the cloth leaves that at some instants, which are independent
// of --fps, also what it passes through, with some room.  Throws what make_cloth() and make_simulation()
// throw.
Framing scene_framing(const Setup& setup, const render::Box& known);
// Does the same before the run, so that several runs share a box; nothing if it draws no pictures or its
// options set what they frame.
std::optional<render::Box> planned_framing(const Setup& setup,
                                           render::Box (*known)(const Scene&, const Cloth&));

}  // namespace hysteron::experiments
