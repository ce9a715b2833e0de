#include "experiments/workbench/pictures/picture_view.h"

#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/scene_renderer.h"

namespace hysteron::experiments {

PictureView picture_view(const Setup& setup, const render::Box& bounds, std::optional<float> floor) {
  for (const Obstacle& o : setup.scene.obstacle)
    if (o.kind == ObstacleKind::ground && !floor) floor = static_cast<float>(o.center.z());
  const Options& options = setup.options;
  render::Look look = scene_look(setup.scene, options, options.looks().front());
  if (look.show != render::Show::cloth) look = scene_look(setup.scene, options, "cloth");
  return {framed_camera(options, bounds), look, options.width(), options.height(), bounds, floor};
}

}  // namespace hysteron::experiments
