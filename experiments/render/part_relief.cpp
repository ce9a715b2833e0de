#include "experiments/render/part_relief.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/pictures.h"
#include "experiments/workbench/pictures/raster.h"
#include "experiments/workbench/session/metric_request.h"
#include "render/local_deviation.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/choice.h"
#include "sim/scene/cloth.h"
#include "sim/scene/cycles.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kTable = "lightness.csv";
constexpr long kFewest = 100;  // least number of pixels for a median

Error refusal(const std::string& name, const std::string& what) {
  return Error::invalid_input("render.part = " + name + " " + what + " (--render.part)")
      .with_key("render.part", name);
}

MetricRequest request_named(const std::string& name, const fs::path& manifest, const Scene& scene) {
  std::vector<std::string> names;
  for (const MetricRequest& request : metrics_in(manifest.string(), scene)) {
    if (!request.has_part()) continue;
    if (request.name == name) return request;
    names.push_back(request.name);
  }
  if (!names.empty()) throw not_a_choice("render.part", name, names);
  throw refusal(name, "must be a [[metric]] of the run's scene that has a part, of which " +
                          manifest.string() + " has none");
}

// Returns for each triangle whether it belongs to the part.
std::vector<char> triangles_of_part(Scene scene, const MetricRequest& request, const DrawnMesh& drawn,
                                    const fs::path& manifest) {
  find_meshes(scene, read_manifest(manifest).meshes, manifest);
  const Cloth cloth = make_cloth(scene);
  if (flat_triangles(cloth.mesh.face) != drawn.triangles)
    throw refusal(request.name, "needs the cloth at rest, and that of the scene has other triangles now");
  std::vector<char> part;
  for (const Eigen::Vector3d& middle : cloth.element_centers(3))
    part.push_back(is_in_box(middle, request.low, request.high));
  return part;
}

// A depth buffer: it holds what is nearest to the eye in each pixel, rows from the top.
class Nearest {
 public:
  Nearest(const render::Camera& camera, int width, int height)
      : width_(width),
        height_(height),
        clip_(camera.projection(static_cast<float>(width) / static_cast<float>(height)) * camera.view()),
        depth_(static_cast<std::size_t>(width) * height, HUGE_VAL),
        cloth(depth_.size(), 0),
        part(depth_.size(), 0) {}

  // Adds a triangle in world coordinates [m], which belongs to the cloth or hides it.
  void add(const std::array<Eigen::Vector3f, 3>& corner, bool is_cloth, bool is_part) {
    std::array<Eigen::Vector2d, 3> at;
    Eigen::Vector3d depth;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector4f c = clip_ * corner[k].homogeneous();
      if (!(c.w() > 0)) return;  // behind the eye
      at[k] = {0.5 * (c.x() / c.w() + 1) * width_, 0.5 * (1 - c.y() / c.w()) * height_};
      depth[k] = c.z() / c.w();
    }
    Eigen::Matrix2d sides;
    sides << at[1] - at[0], at[2] - at[0];
    if (sides.determinant() == 0) return;
    const Eigen::Matrix2d shares = sides.inverse();
    for_each_cell(at, width_, height_, [&](int i, int j) {
      const Eigen::Vector2d share = shares * (Eigen::Vector2d(i + 0.5, j + 0.5) - at[0]);
      const double here = depth[0] + share.x() * (depth[1] - depth[0]) + share.y() * (depth[2] - depth[0]);
      const std::size_t pixel = static_cast<std::size_t>(j) * width_ + i;
      if (here >= depth_[pixel]) return;
      depth_[pixel] = here;
      cloth[pixel] = is_cloth;
      part[pixel] = is_part;
    });
  }

 private:
  int width_, height_;
  Eigen::Matrix4f clip_;
  std::vector<double> depth_;

 public:
  std::vector<char> cloth, part;
};

void add_obstacles(const std::vector<Obstacle>& obstacles, double time, Nearest& nearest) {
  for (const Obstacle& o : obstacles) {
    if (!o.visible || time < o.from || time >= o.until) continue;
    const std::optional<render::TriangleMesh> mesh = obstacle_mesh(o, render::kSeen, time);
    if (!mesh) continue;
    const Eigen::Matrix4f place = placed_at(o, time);
    for (std::size_t t = 0; t + 2 < mesh->triangles.size(); t += 3) {
      const auto at = [&](std::size_t k) -> Eigen::Vector3f {
        return (place * mesh->positions[mesh->triangles[t + k]].homogeneous()).hnormalized();
      };
      nearest.add({at(0), at(1), at(2)}, false, false);
    }
  }
}

void fade(render::Image& image, const std::vector<char>& part) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (!part[static_cast<std::size_t>(y) * image.width() + x])
        for (int c = 0; c < 3; ++c)
          image.at(x, y)[c] = static_cast<std::uint8_t>(255 - (255 - image.at(x, y)[c]) / 4);
}

// Returns the last kept instant that is not after a time, up to rounding; the first one if there is none.
std::size_t instant_at(const std::vector<ArchivedState>& instants, double time) {
  constexpr double kRounding = 1e-9;  // [s]
  std::size_t found = 0;
  for (std::size_t i = 0; i < instants.size(); ++i)
    if (instants[i].time <= time + kRounding) found = i;
  return found;
}

// Returns the instants before the wrinkles, at the ends of cycles, and at the end.
std::vector<std::size_t> chosen_instants(const std::vector<ArchivedState>& instants,
                                         const MetricRequest& request, const Scene& scene) {
  std::vector<std::size_t> chosen = {instant_at(instants, request.from)};
  const Cycles cycles = scene_cycles(scene);
  for (int cycle = 1; cycles.repeat() && cycle <= cycles.count; ++cycle)
    chosen.push_back(instant_at(instants, cycles.end_of(cycle)));
  chosen.push_back(instants.size() - 1);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

class PartRelief {
 public:
  PartRelief(Run& run, const Setup& setup, const DrawnMesh& mesh, const ArchivedCloth& cloth,
             const std::vector<char>& part, const std::string& name)
      : run_(run), setup_(setup), mesh_(mesh), cloth_(cloth), part_(part), name_(name) {
    auto subject = std::make_unique<ArchivedSource>(mesh, cloth.instants);
    subject_ = subject.get();
    pictures_ = std::make_unique<Pictures>(setup, std::move(subject), cloth.bounds, cloth.floor);
  }

  // Returns the deviation of lightness at an instant and draws its picture.
  double deviation(std::size_t instant) {
    subject_->go_to(instant);
    const render::Camera camera = pictures_->camera();
    render::Image image = pictures_->picture(setup_.options.looks().front(), camera, "");
    const Nearest nearest = seen(cloth_.instants[instant], camera, image.width(), image.height());
    const render::LocalDeviation found = render::local_deviation(image, nearest.cloth, nearest.part);
    if (found.pixels < kFewest)
      throw refusal(name_,
                    fmt::format("has {} pixels with nothing but cloth within 21 pixels at t = {:.3f} s, and "
                                "{} are needed: give a larger --size, or a --camera.direction and "
                                "--camera.box that show it",
                                found.pixels, cloth_.instants[instant].time, kFewest));
    fade(image, nearest.part);
    pictures_->write(run_.path(fmt::format("part-{}.png", drawn_++)), std::move(image));
    pixels_ = found.pixels;
    return found.median;
  }
  long pixels() const { return pixels_; }  // pixels of the part in the last picture

 private:
  Nearest seen(const ArchivedState& state, const render::Camera& camera, int width, int height) const {
    Nearest nearest(camera, width, height);
    for (std::size_t t = 0; t < part_.size(); ++t) {
      const auto at = [&](std::size_t k) -> Eigen::Vector3f {
        return Eigen::Map<const Eigen::Vector3f>(
            &state.xyz[3 * static_cast<std::size_t>(mesh_.triangles[3 * t + k])]);
      };
      nearest.add({at(0), at(1), at(2)}, true, part_[t] != 0);
    }
    add_obstacles(setup_.scene.obstacle, state.time, nearest);
    return nearest;
  }

  Run& run_;
  const Setup& setup_;
  const DrawnMesh& mesh_;
  const ArchivedCloth& cloth_;
  const std::vector<char>& part_;
  const std::string name_;
  ArchivedSource* subject_ = nullptr;
  std::unique_ptr<Pictures> pictures_;
  int drawn_ = 0;
  long pixels_ = 0;
};

}  // namespace

void draw_part_relief(const CommandLine& line, const fs::path& file, const Archived& kept, Setup setup,
                      const std::string& name) {
  if (kept.cloths.size() > 1) throw refusal(name, "is of one run, and " + file.string() + " keeps several");
  const ArchivedCloth& cloth = kept.cloths.front();
  const DrawnMesh& mesh = kept.meshes.at(cloth.mesh);
  const fs::path manifest = file.parent_path() / "manifest.json";
  const MetricRequest request = request_named(name, manifest, setup.scene);
  const std::vector<char> part = triangles_of_part(setup.scene, request, mesh, manifest);
  setup.options.plain = true;
  Run run(line, setup.options, {{"kept", file.string()}, {"part", name}, {"scene", cloth.setup.at("scene")}});
  run.reserve({kTable, "part-0.png"});
  PartRelief relief(run, setup, mesh, cloth, part, name);
  Table table("time [s],lightness_deviation,added,pixels");
  double before = NAN, last = NAN;
  for (const std::size_t instant : chosen_instants(cloth.instants, request, setup.scene)) {
    last = relief.deviation(instant);
    if (std::isnan(before)) before = last;
    table.row({cloth.instants[instant].time, last, last - before, relief.pixels()});
  }
  table.write(run.path(kTable));
  run.metric("lightness_deviation_before", before);
  run.metric("lightness_deviation", last);
  run.metric("lightness_deviation_added", last - before);
  finish_with_report(run);
}

}  // namespace hysteron::experiments
