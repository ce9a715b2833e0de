// What the pictures of a run show, for files that other programs draw.
#pragma once

#include <optional>

#include "experiments/workbench/app/experiment.h"
#include "render/camera.h"
#include "render/look.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct PictureView {
  render::Camera camera;
  render::Look look;
  int width = 0, height = 0;   // [pixels]
  render::Box bounds;          // of what is lit [m]
  std::optional<float> floor;  // height of the visible ground [m]

  float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

// What the options' pictures show, in the look of cloth where theirs shows a value.
PictureView picture_view(const Setup& setup, const render::Box& bounds, std::optional<float> floor);

}  // namespace hysteron::experiments
