// Describes the pictures of a run for files that other programs draw.
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
  render::Box bounds;          // lit bounds [m]
  std::optional<float> floor;  // height of the visible ground [m]

  float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

// Returns the view of the options' pictures, in the look of cloth if theirs shows a value.
PictureView picture_view(const Setup& setup, const render::Box& bounds, std::optional<float> floor);

}  // namespace hysteron::experiments
