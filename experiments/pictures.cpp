#include "experiments/pictures.h"

#include <chrono>
#include <cstdio>

#include "experiments/wrinkles.h"
#include "render/caption.h"
#include "render/shapes.h"
#include "sim/scene/motion.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSheetCells = 12;                     // pictures on the contact sheet
constexpr int kThumbnailWidth = 640;                // kept in memory until then [pixels]
constexpr double kCurvatureRange = 2;               // colours span this many K0 on either side
constexpr double kResidualRange = 1;                // the same for residual curvature
const Eigen::Vector3f kRaking{0.94f, 0.2f, 0.25f};  // light from the left, a little from the front and above
constexpr float kRakingRoom = 0.22f;                // in a dim room

std::vector<float> flat(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> xyz;
  xyz.reserve(3 * points.size());
  for (const auto& p : points)
    for (int k = 0; k < 3; ++k) xyz.push_back(static_cast<float>(p[k]));
  return xyz;
}

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

std::vector<float> vertex_average(const Cloth& cloth, const std::vector<double>& element, int dimension) {
  const ClothMesh& mesh = cloth.mesh;
  std::vector<float> sum(mesh.vertices(), 0), weight(mesh.vertices(), 0);
  const auto add = [&](int vertex, double value, double area) {
    sum[vertex] += static_cast<float>(area * value);
    weight[vertex] += static_cast<float>(area);
  };
  for (std::size_t e = 0; e < element.size(); ++e) {
    if (dimension == 3) {
      for (int k = 0; k < 3; ++k) add(mesh.face[e][k], element[e], mesh.face_area[e]);
    } else {
      const Edge& edge = mesh.edge[e];
      const double area = mesh.face_area[edge.face0] + mesh.face_area[edge.face1];
      for (int vertex : {edge.p2, edge.p3}) add(vertex, element[e], area);
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (weight[i] > 0) sum[i] /= weight[i];
  return sum;
}

std::vector<float> vertex_curvature(const Cloth& cloth, const std::vector<double>& element, int dimension) {
  if (dimension == 1) return vertex_average(cloth, element, 1);
  std::vector<double> trace(element.size() / 3);
  for (std::size_t f = 0; f < trace.size(); ++f) trace[f] = element[3 * f] + element[3 * f + 1];
  return vertex_average(cloth, trace, 3);
}

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
  std::vector<int> triangles;
  for (const auto& t : cloth.mesh.face) triangles.insert(triangles.end(), {t[0], t[1], t[2]});
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

render::Camera Pictures::camera() const {
  const float aspect = static_cast<float>(options_.width()) / static_cast<float>(options_.height());
  return render::Camera::framing(bounds_, options_.camera_direction.cast<float>(),
                                 static_cast<float>(options_.camera_fov), aspect);
}

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
  look.background = render::background_named(options_.background);
  if (options_.light == "raking") {
    const Eigen::Vector3f back = options_.camera_direction.cast<float>().normalized();
    const Eigen::Vector3f left = back.cross(Eigen::Vector3f::UnitZ()).normalized();
    look.room = kRakingRoom;
    look.to_light = kRaking.x() * left + kRaking.y() * back + kRaking.z() * Eigen::Vector3f::UnitZ();
  }
  return look;
}

void Pictures::show(render::ClothView& view, const std::string& look_name) {
  const render::Look look = look_of(look_name);
  if (look.show == render::Show::curvature) {
    view.set_values(vertex_curvature(
        cloth_, look_name == "residual" ? simulation_.residual_curvature() : simulation_.curvature(),
        simulation_.dimension()));
  } else if (look.show == render::Show::friction) {
    view.set_values(vertex_average(cloth_, simulation_.friction_share(), simulation_.dimension()));
  }
  view.set_look(look);
  if (!view.write_positions(why_host_)) view.set_positions(flat(simulation_.positions()));
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

render::Image Pictures::picture(const std::string& look_name, const render::Camera& camera,
                                const std::string& text) {
  const auto start = Clock::now();
  show(*view_, look_name);
  for (std::size_t i = 0; i < obstacle_.size(); ++i) {
    if (obstacle_[i] < 0) continue;
    view_->move_obstacle(obstacle_[i], placed_at(scene_.obstacle[i], simulation_.time()));
    const Obstacle& o = scene_.obstacle[i];
    view_->show_obstacle(obstacle_[i], o.from <= simulation_.time() && simulation_.time() < o.until);
  }
  render::Image image = view_->draw(camera);
  if (options_.background != "transparent")  // a figure has its own
    render::draw_caption(image, text, render::Corner::top_left);
  render::draw_scale_bar(image, camera.metres_per_pixel(bounds_.center(), image.height()),
                         render::Corner::bottom_left, "at the cloth's middle");
  const render::Look look = look_of(look_name);
  if (look.show == render::Show::curvature) {
    const char* what = look_name == "residual" ? "residual curvature" : "curvature";
    render::draw_color_bar(image, {look.map, look.value_low, look.value_high, what, "1/m"},
                           render::Corner::bottom_right);
  } else if (look.show == render::Show::friction) {
    render::draw_color_bar(image, {look.map, 0, 1, "friction moment / M0", ""}, render::Corner::bottom_right);
  }
  render_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
  return image;
}

void Pictures::frame(Run& run) {
  render::Image image = picture(options_.look, camera(), caption(simulation_.time()));
  char name[32];
  std::snprintf(name, sizeof name, "frames/%04d.png", frames_++);
  const int width = std::min(kThumbnailWidth, image.width());
  thumbnails_.push_back({render::shrink(image, width, std::max(1, image.height() * width / image.width())),
                         when(simulation_.time())});
  writer_.write(run.path(name), std::move(image));
}

render::Image Pictures::silhouette(double half_width, int pixels, double& metres_per_pixel) {
  render::ClothView view(*offscreen_, {pixels, pixels});
  std::vector<int> triangles;
  for (const auto& t : cloth_.mesh.face) triangles.insert(triangles.end(), {t[0], t[1], t[2]});
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
