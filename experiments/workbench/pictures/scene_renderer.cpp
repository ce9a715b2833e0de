#include "experiments/workbench/pictures/scene_renderer.h"

#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/drawn_body.h"
#include "experiments/workbench/pictures/fabric_look.h"
#include "render/shapes.h"
#include "sim/base/error.h"
#include "sim/device/cpu.h"
#include "sim/scene/body.h"
#include "sim/scene/motion.h"
#include "sim/scene/scene_text.h"

namespace hysteron::experiments {
namespace {

constexpr int kShadowSamples = 4, kShadowTile = 512;  // samples per pixel; tile of pixels
constexpr double kCurvatureRange = 2;                 // colours span this many K0 on either side

// Returns the range of the colours [1/m], half as wide for residuals and differences as for curvature.
double curvature_range(const Scene& scene, const Options& options, const std::string& look) {
  const double range = options.curvature_range > 0 ? options.curvature_range
                                                   : kCurvatureRange * scene.fabric.friction_curvature();
  return look == "curvature" ? range : range / 2;
}

constexpr double kMuch = 0.2;  // share of hidden cloth above which obstacles become translucent
constexpr int kGhost = 90;     // their opacity then, of 256

render::Image between(render::Image bare, const render::Image& whole, int fraction) {
  for (std::size_t i = 0; i < bare.pixels().size(); ++i)
    bare.pixels()[i] = static_cast<std::uint8_t>(
        ((256 - fraction) * bare.pixels()[i] + fraction * whole.pixels()[i] + 128) / 256);
  return bare;
}

}  // namespace

std::optional<render::TriangleMesh> obstacle_mesh(const Obstacle& o, const render::ShapeDetail& detail,
                                                  double time, double quantum) {
  const auto f = [](double x) { return static_cast<float>(x); };
  switch (o.kind) {
    case ObstacleKind::ground:
    case ObstacleKind::hollow:
      return {};
    case ObstacleKind::sphere:
      return render::sphere_mesh(f(o.radius), detail);
    case ObstacleKind::capsule:
      return render::capsule_mesh(f(o.radius), f(o.height), detail);
    case ObstacleKind::torus:
      return render::torus_mesh(f(o.radius), f(o.height), detail);
    case ObstacleKind::box:
      return render::box_mesh(o.size.cast<float>(), f(o.rim), detail);
    case ObstacleKind::cylinder:
      return render::cylinder_mesh(f(o.radius), f(o.height), f(o.rim), detail);
    case ObstacleKind::mesh:
      if (!o.mesh) return {};
      return body_surface(*o.mesh, drawn_body(o, time, quantum));
  }
  return {};
}

Eigen::Matrix4f placed_at(const Obstacle& o, double time) {
  const Placement at = placement(o.motion, time);
  Eigen::Matrix4f motion = Eigen::Matrix4f::Identity();
  motion.topLeftCorner<3, 3>() = (at.scale * at.rotation).cast<float>();
  motion.topRightCorner<3, 1>() = at.translation.cast<float>();
  const Eigen::Vector3d axis = is_body(o) ? Eigen::Vector3d::UnitZ() : o.axis.normalized();
  return motion * render::placed(o.center.cast<float>(), axis.cast<float>());
}

render::ColorMap look_color_map(const std::string& look) { return render::look_named(look).map; }

render::Look scene_look(const Scene& scene, const Options& options, const std::string& name) {
  render::Look look = render::look_named(name);
  if (look.show == render::Show::curvature) {
    look.value_high = static_cast<float>(curvature_range(scene, options, name));
    look.value_low = -look.value_high;
  } else if (look.show == render::Show::friction) {
    look.value_low = 0;
    look.value_high = 1;
  }
  look.thickness = static_cast<float>(scene.fabric.thickness);
  return apply_fabric_look(apply_lighting(look, options), fabric_to_read(scene));
}

std::optional<render::ColorBar> value_color_bar(const Scene& scene, const Options& options,
                                                const std::string& name) {
  const render::Look look = scene_look(scene, options, name);
  if (look.show == render::Show::curvature) {
    const char* what = name == "residual"     ? "residual curvature"
                       : name == "difference" ? "difference of curvature"
                                              : "curvature";
    return render::ColorBar{look.map, look.value_low, look.value_high, what, "1/m"};
  }
  if (look.show == render::Show::friction)
    return render::ColorBar{look.map, 0, 1,
                            name == "height" ? "height, from lowest to highest" : "friction moment / M0", ""};
  return {};
}

SceneRenderer::SceneRenderer(const Scene& scene, const Options& options, const DrawnMesh& mesh,
                             const render::Box& bounds, std::optional<float> floor, int cuda_device)
    : mesh_(mesh),
      bounds_(bounds),
      floor_(floor),
      scenery_(scene.obstacle),
      offscreen_(render::Offscreen::create(options.renderer, cuda_device)) {
  take_size(picture_size(options));
}

void SceneRenderer::take_size(const render::PictureSize& size) {
  size_ = size;
  if (view_ && !view_->is_figure() && size.figure_passes == 0) {
    view_->share_positions({});
    view_->resize(size);
    return;
  }
  view_.reset();
  view_ = std::make_unique<render::ClothView>(*offscreen_, size);
  view_->set_cloth({mesh_.vertices, mesh_.triangles, mesh_.pattern});
  body_.clear();
  shaped_at_ = 0;
  for (const Obstacle& o : scenery_) {
    const auto body = surface_of(o, render::kSeen, 0), caster = surface_of(o, render::kCaster, 0);
    body_.push_back(body && o.visible ? view_->add_obstacle(*body, placed_at(o, 0), &*caster) : -1);
    if (o.kind == ObstacleKind::ground && !floor_) floor_ = static_cast<float>(o.center.z());
  }
  view_->set_ground(floor_);
  view_->set_bounds(bounds_);
}

std::optional<render::TriangleMesh> SceneRenderer::surface_of(const Obstacle& o,
                                                              const render::ShapeDetail& detail,
                                                              double time) const {
  return obstacle_mesh(o, detail, time, body_quantum(o, mesh_.quantum));
}

void SceneRenderer::place_obstacles(double time, bool visible) {
  for (std::size_t i = 0; i < body_.size(); ++i) {
    if (body_[i] < 0) continue;
    const Obstacle& o = scenery_[i];
    const bool there = o.from <= time && time < o.until;
    if (is_body(o) && o.mesh->moves() && time != shaped_at_)
      view_->reshape_obstacle(body_[i], *surface_of(o, render::kSeen, time));
    view_->move_obstacle(body_[i], placed_at(o, time));
    view_->show_obstacle(body_[i], visible && there);
  }
  shaped_at_ = time;
}

render::Image SceneRenderer::draw(const render::Look& look, const render::Camera& camera,
                                  const Shown& shown) {
  std::optional<ReservedCore> core;
  if (!offscreen_->egl_device_is_hardware()) core.emplace();
  if (!shown.values.empty()) view_->set_values(shown.values);
  view_->set_look(look);
  place_obstacles(shown.time, true);
  return view_->draw(camera);
}

render::Image SceneRenderer::draw_with_ghosts(const render::Look& look, const render::Camera& camera,
                                              const Shown& shown) {
  render::Image whole = draw(look, camera, shown);
  if (view_->hidden_fraction() <= kMuch) return whole;
  place_obstacles(shown.time, false);
  return between(view_->draw(camera), whole, kGhost);
}

render::Image SceneRenderer::silhouette(const std::vector<float>& xyz, const render::Camera& camera,
                                        int pixels) {
  const render::PictureSize size = size_;
  take_size({.width = pixels, .height = pixels, .samples = kShadowSamples, .tile = kShadowTile});
  view_->set_look(render::look_named("silhouette"));
  view_->set_positions(xyz);
  render::Image image = view_->draw(camera);
  if (!view_->shows_cloth()) throw Error::simulation("the silhouette from above shows no cloth");
  take_size(size);
  return image;
}

}  // namespace hysteron::experiments
