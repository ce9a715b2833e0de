#include "render/light_pass.h"

namespace hysteron::render {
namespace {

// Returns all that shadows and the room's light depend on, but for the cloth's positions.
std::vector<float> what_lights(const ViewScene& scene, const Box& box, const Eigen::Vector3f& to_light) {
  std::vector<float> all = {scene.look.room, scene.look.obstacle_inset,
                            scene.ground_height.has_value() ? 1.0f : 0.0f, scene.pictured_ground()};
  for (const Eigen::Vector3f& v : {box.low, box.high, to_light}) all.insert(all.end(), v.begin(), v.end());
  const std::vector<float> bodies = scene.obstacles.state();
  all.insert(all.end(), bodies.begin(), bodies.end());
  return all;
}

}  // namespace

LightPass::LightPass(const GlFunctions& gl, int figure_passes) : shadows_(gl) {
  if (figure_passes > 0) figure_light_.emplace(gl, figure_passes);
}

void LightPass::update(ViewScene& scene, const Camera& camera) {
  const Box box = scene.bounds();
  const Eigen::Vector3f to_light = scene.to_light(camera);
  if (scene.ground_height) scene.ground->be_layer(scene.is_transparent());
  if (figure_light_) {
    figure_light_->aim(box, to_light, scene.look.room);
    if (scene.ground_height) scene.ground->place(box, scene.pictured_ground());
    return;
  }
  const std::vector<float> lights = what_lights(scene, box, to_light);
  if (lights == known_) return;
  known_ = lights;
  shadows_.aim(box, to_light, scene.look.room);
  shadows_.draw([&](const Program& program) { scene.draw_casters(program); });
  if (scene.cloth) scene.cloth->surface().update_sky(shadows_);
  scene.obstacles.update_sky(shadows_, scene.fit());
  if (scene.ground_height) scene.ground->update(shadows_, box, scene.pictured_ground());
}

void LightPass::begin_pass(int pass, const ViewScene& scene) {
  if (figure_light_) figure_light_->draw(pass, [&](const Program& p) { scene.draw_casters(p); });
}

void LightPass::bind(const Program& program) const {
  if (figure_light_)
    figure_light_->bind(program);
  else
    shadows_.bind(program);
}

}  // namespace hysteron::render
