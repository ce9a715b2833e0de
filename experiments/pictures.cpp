#include "experiments/pictures.h"

#include <chrono>
#include <cstdio>

#include "experiments/drawing.h"
#include "experiments/wrinkles.h"
#include "render/shapes.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/scene/motion.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSheetCells = 12;        // pictures on the contact sheet
constexpr double kCurvatureRange = 2;  // colours span this many K0 on either side
constexpr double kResidualRange = 1;   // the same for residual curvature

std::vector<float> pattern_of(const ClothMesh& mesh, const ClothShape& shape) {
  std::vector<float> uv;
  if (shape.shape == "tube") {
    for (const Eigen::Vector2d& p : unrolled(mesh, shape))
      uv.insert(uv.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    return uv;
  }
  const Eigen::Vector3d weft = Eigen::Vector3d::UnitZ().cross(mesh.warp_axis);
  for (int i = 0; i < mesh.vertices(); ++i) {
    const bool given = !mesh.pattern.empty();
    uv.push_back(static_cast<float>(given ? mesh.pattern[i].x() : mesh.rest[i].dot(mesh.warp_axis)));
    uv.push_back(static_cast<float>(given ? mesh.pattern[i].y() : mesh.rest[i].dot(weft)));
  }
  return uv;
}

render::TriangleMesh body_of(const Obstacle& o) {
  const auto f = [](double x) { return static_cast<float>(x); };
  if (o.kind == "sphere") return render::sphere_mesh(f(o.radius));
  if (o.kind == "capsule") return render::capsule_mesh(f(o.radius), f(o.height));
  if (o.kind == "box") return render::box_mesh(o.size.cast<float>(), f(o.rim));
  return render::cylinder_mesh(f(o.radius), f(o.height), f(o.rim));
}

Eigen::Matrix4f placed_at(const Obstacle& o, double time) {
  const Placement at = placement(o.motion, time);
  Eigen::Matrix4f motion = Eigen::Matrix4f::Identity();
  motion.topLeftCorner<3, 3>() = (at.scale * at.rotation).cast<float>();
  motion.topRightCorner<3, 1>() = at.translation.cast<float>();
  return motion * render::placed(o.center.cast<float>(), o.axis.normalized().cast<float>());
}

}  // namespace

Pictures::Pictures(const Setup& setup, const Cloth& cloth, Simulation& simulation, const render::Box& bounds,
                   std::optional<float> floor)
    : scene_(setup.scene),
      options_(setup.options),
      cloth_(cloth),
      simulation_(simulation),
      bounds_(bounds),
      offscreen_(render::Offscreen::create(render::renderer_named(setup.options.renderer),
                                           simulation.cuda_device())) {
  view_ = std::make_unique<render::ClothView>(*offscreen_,
                                              render::PictureSize{options_.width(), options_.height()});
  const std::vector<int> triangles = flat_triangles(cloth.mesh.face);
  const std::vector<float> pattern = pattern_of(cloth.mesh, setup.scene.cloth);
  view_->set_cloth({static_cast<size_t>(cloth.mesh.vertices()), triangles, pattern});
  for (const Obstacle& o : scene_.obstacle) {
    const bool body = o.kind != "ground" && o.kind != "hollow" && o.visible;
    obstacle_.push_back(body ? view_->add_obstacle(body_of(o), placed_at(o, 0)) : -1);
    if (o.kind == "ground" && !floor) floor = static_cast<float>(o.center.z());
  }
  view_->set_ground(floor);
  view_->set_bounds(bounds);
  view_->share_positions(
      simulation.share_positions(view_->position_buffer(), offscreen_->cuda_device(), why_host_));
}

render::Camera Pictures::camera() const { return camera_of(options_, bounds_); }

// The look with its light and the ends of its colour map.  `residual` is the map of curvatures.
render::Look Pictures::look_of(const std::string& name) const {
  render::Look look = render::look_named(name == "residual" ? "curvature" : name);
  if (look.show == render::Show::curvature) {
    const double range = name == "residual" ? kResidualRange : kCurvatureRange;
    look.value_high = static_cast<float>(range * scene_.fabric.k0);
    look.value_low = -look.value_high;
  } else if (look.show == render::Show::friction) {
    look.value_low = 0;
    look.value_high = 1;
  }
  return lit(look, options_);
}

void Pictures::show(render::ClothView& view, const std::string& look_name) {
  const render::Look look = look_of(look_name);
  if (look.show == render::Show::curvature) {
    view.set_values(vertex_curvature(
        cloth_.mesh, look_name == "residual" ? simulation_.residual_curvature() : simulation_.curvature(),
        simulation_.dimension()));
  } else if (look.show == render::Show::friction) {
    view.set_values(vertex_average(cloth_.mesh, simulation_.friction_share(), simulation_.dimension()));
  }
  view.set_look(look);
  if (!view.write_positions(why_host_)) view.set_positions(flat_points(simulation_.positions()));
}

std::string Pictures::when(double time) const {
  char text[64];
  std::snprintf(text, sizeof text, "t = %.2f s", time);
  const std::string phase = scene_.phase_at(time);
  return text + (phase.empty() ? "" : ", " + phase);
}

std::string Pictures::caption(double time) const {
  return scene_.fabric.name + ", law " + scene_.law + "\n" + when(time);
}

// A figure, whose background is transparent, has a caption of its own.
std::string Pictures::captioned(const std::string& text) const {
  return options_.background == "transparent" ? "" : text;
}

render::Image Pictures::drawn(const std::string& look_name, const render::Camera& camera) {
  const auto start = Clock::now();
  show(*view_, look_name);
  for (std::size_t i = 0; i < obstacle_.size(); ++i) {
    if (obstacle_[i] < 0) continue;
    view_->move_obstacle(obstacle_[i], placed_at(scene_.obstacle[i], simulation_.time()));
    const Obstacle& o = scene_.obstacle[i];
    view_->show_obstacle(obstacle_[i], o.from <= simulation_.time() && simulation_.time() < o.until);
  }
  render::Image image = view_->draw(camera);
  render_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
  return image;
}

std::optional<render::ColorBar> Pictures::color_bar(const std::string& look_name) const {
  const render::Look look = look_of(look_name);
  if (look.show == render::Show::curvature) {
    const char* what = look_name == "residual" ? "residual curvature" : "curvature";
    return render::ColorBar{look.map, look.value_low, look.value_high, what, "1/m"};
  }
  if (look.show == render::Show::friction)
    return render::ColorBar{look.map, 0, 1, "friction moment / M0", ""};
  return {};
}

render::Image Pictures::picture(const std::string& look, const render::Camera& camera,
                                const std::string& text) {
  render::Image image = drawn(look, camera);
  letter(image, camera, bounds_.center(), captioned(text), color_bar(look));
  return image;
}

// What a page that compares runs has to know of their pictures.
void Pictures::note_frame(Run& run) {
  moments_.push_back({{"s", simulation_.time()}, {"phase", scene_.phase_at(simulation_.time())}});
  Json looks = Json::object();
  for (const std::string& look : options_.looks()) {
    looks[look] = nullptr;
    if (const auto bar = color_bar(look))
      looks[look] = {{"label", bar->label}, {"unit", bar->unit}, {"low", bar->low}, {"high", bar->high}};
  }
  run.note("frames", {{"looks", looks},
                      {"m_per_pixel", camera().metres_per_pixel(bounds_.center(), options_.height())},
                      {"moments", moments_}});
}

void Pictures::frame(Run& run) {
  const std::vector<std::string> looks = options_.looks();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    render::Image image = drawn(looks[i], camera());
    if (!options_.plain)
      letter(image, camera(), bounds_.center(), captioned(caption(simulation_.time())), color_bar(looks[i]));
    char name[32];
    std::snprintf(name, sizeof name, "/%04d.png", frames_);
    if (i == 0) thumbnails_.push_back({thumbnail(image), when(simulation_.time())});
    writer_.write(run.path((i == 0 ? "frames" : "frames-" + looks[i]) + name), std::move(image));
  }
  ++frames_;
  note_frame(run);
}

render::Image Pictures::silhouette(double half_width, int pixels, double& metres_per_pixel) {
  render::ClothView view(*offscreen_, {pixels, pixels});
  const std::vector<int> triangles = flat_triangles(cloth_.mesh.face);
  view.set_cloth({static_cast<size_t>(cloth_.mesh.vertices()), triangles, {}});
  show(view, "silhouette");
  const float r = static_cast<float>(half_width);
  const render::Box box{{-r, -r, bounds_.low.z()}, {r, r, bounds_.high.z()}};
  const render::Camera camera = render::Camera::top(box, 1);
  metres_per_pixel = camera.metres_per_pixel(box.center(), pixels);
  return view.draw(camera);
}

void Pictures::finish(Run& run, const std::string& title) {
  writer_.finish();
  std::vector<render::SheetEntry> cells;
  for (int i : render::spread(static_cast<int>(thumbnails_.size()), kSheetCells))
    cells.push_back(std::move(thumbnails_[i]));
  if (!cells.empty())
    render::write_png(run.path("sheet.png"), render::contact_sheet(cells, {.title = title}),
                      render::PngEffort::best);
  run.note("renderer", renderer());
  run.note("positions", positions_way());
  run.add_seconds("render", render_seconds_);
  run.add_seconds("encode", writer_.encode_seconds());
}

}  // namespace hysteron::experiments
