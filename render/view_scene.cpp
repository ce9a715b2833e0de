#include "render/view_scene.h"

#include "render/key_light.h"

namespace hysteron::render {

// A figure has the box of its own instant, if known: the tighter, the sharper its shadows.
Box ViewScene::bounds() const {
  const std::optional<Box> of_cloth = cloth ? cloth->box() : std::nullopt;
  if (given_bounds && !(is_figure && of_cloth)) return *given_bounds;
  return obstacles.merged(of_cloth).value_or(Box{{-1, -1, -1}, {1, 1, 1}});
}

// The middle of a sheet on the ground rests a thickness above it, its lower side half of that.
float ViewScene::pictured_ground() const {
  const float height = ground_height.value_or(0);
  return has_thickness(look.show) ? height + 0.5f * look.thickness : height;
}

// Only a figure's own plane turns its light: that of a sequence would flicker.
Eigen::Vector3f ViewScene::to_light(const Camera& camera) const {
  return key_direction(look, camera, is_figure && cloth ? cloth->normal() : std::nullopt);
}

void ViewScene::draw_casters(const Program& program) const {
  obstacles.draw_casters(program, fit());
  place_cloth(program);
  if (cloth) cloth->surface().draw();
}

}  // namespace hysteron::render
