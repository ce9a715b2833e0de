// What pictures frame where the scene alone says where its cloth goes: all that the cloth passes through.
#pragma once

#include <optional>
#include <string>

#include "experiments/workbench/app/experiment.h"
#include "render/camera.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct Framing {
  render::Box box;        // [m]
  int triangles = 0;      // of the trial that it was found by
  std::string stopped{};  // why that ended early; empty: it did not
};

// Simulates the scene on a coarse mesh, or on its own where that is a file, and frames `known`, which the
// cloth is expected to pass through; where it leaves that at some of its instants, which --fps does not move,
// with some room, what it passes through as well.  Throws what make_cloth() and make_simulation() do.
Framing scene_framing(const Setup& setup, const render::Box& known);
// The same before the run, so that several have one; nothing where it draws no pictures or its options say
// what they frame.
std::optional<render::Box> planned_framing(const Setup& setup,
                                           render::Box (*known)(const Scene&, const Cloth&));

}  // namespace hysteron::experiments
