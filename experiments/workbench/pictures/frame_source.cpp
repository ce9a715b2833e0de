#include "experiments/workbench/pictures/frame_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/ridge_metrics.h"
#include "sim/base/error.h"
#include "sim/base/root_mean_square.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/mesh/surface.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kStepsAnEdge = 256;  // quanta in the mean edge: normals rotate by 0.2 degrees at most

// Returns the height of each vertex, from 0 for the lowest to 1 for the highest.
std::vector<float> heights(const std::vector<float>& xyz) {
  std::vector<float> height;
  for (std::size_t i = 2; i < xyz.size(); i += 3) height.push_back(xyz[i]);
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  const float least = *low, span = std::max(*high - least, std::numeric_limits<float>::min());
  for (float& z : height) z = (z - least) / span;
  return height;
}

// Returns the length of the side between two vertices in a drawn mesh's pattern [m].
double pattern_length(const DrawnMesh& mesh, int a, int b) {
  const auto at = [&](int vertex) {
    const float* uv = &mesh.pattern[2 * static_cast<std::size_t>(vertex)];
    return Eigen::Vector2d(uv[0], uv[1]);
  };
  return (at(a) - at(b)).norm();
}

// True if two meshes of the same triangles have sides of the same length at rest, to the precision of
// pictures: in the mean, and one by one if both have a pattern, in which warp may have any angle.
bool has_same_rest_shape(const DrawnMesh& a, const DrawnMesh& b) {
  constexpr double kRounding = 1e-6;  // relative, for the mean side
  constexpr double kQuanta = 2;       // largest change of a side by rounding
  if (std::abs(a.quantum - b.quantum) > kRounding * a.quantum) return false;
  if (a.pattern.empty() || a.pattern.size() != b.pattern.size()) return true;
  for (std::size_t t = 0; t + 2 < a.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = a.triangles[t + k], to = a.triangles[t + (k + 1) % 3];
      if (std::abs(pattern_length(a, from, to) - pattern_length(b, from, to)) > kQuanta * a.quantum)
        return false;
    }
  return true;
}

// Another run of the same cloth, whose curvature is subtracted from this one's.
class ReferenceRun {
 public:
  // Reads the `folder` of a run with pictures and `--export ply`.  Throws Error::invalid_input if it is none.
  explicit ReferenceRun(fs::path folder) : folder_(std::move(folder)) {
    const fs::path file = folder_ / "manifest.json";
    const Json json = json_or_none(file);
    if (json.is_object())
      if (const Manifest manifest = checked_manifest(json, file); manifest.frames) {
        for (const Frames::Instant& instant : manifest.frames->instants) time_.push_back(instant.time);
        if (manifest.keys) step_ = manifest.number("step");
        rests_ = manifest.metrics["settled"].is(true);
      }
    std::error_code ignored;
    if (time_.empty() || !fs::exists(folder_ / "mesh" / "0000.ply", ignored))
      throw refusal("must be the folder of a run with pictures and --export ply");
  }

  // Throws Error::invalid_input if its triangles, or their rest shape, are not those of `mesh`.
  void check(const ClothMesh& mesh, const ClothShape& shape) const {
    curvature_in(mesh, 0);
    const fs::path kept = folder_ / kArchivedFrames;
    std::error_code ignored;
    if (fs::exists(kept, ignored) && !has_same_rest_shape(drawn_mesh(mesh, shape), read_archived_mesh(kept)))
      throw refusal(
          "has another rest shape than this cloth, though as many triangles: run it with the same "
          "mesh");
  }

  // True if curvature() knows that of `time` [s] of a run with steps of `step` [s].
  bool has_instant(const ClothMesh& mesh, double time, double step) const {
    return is_instant(time, step) || between_instants(mesh, time);
  }

  // Returns one curvature per vertex [1/m] at `time` [s] of a run with steps of `step` [s]; nothing if this
  // run moves there and has no such instant.  Throws as check() does for other triangles.
  std::optional<std::vector<float>> curvature(const ClothMesh& mesh, double time, double step) const {
    if (is_instant(time, step)) return curvature_in(mesh, nearest(time));
    return between_instants(mesh, time);
  }

 private:
  // True if an instant is that of `time`: both runs record the step nearest to it, so that they agree to half
  // of both steps.  A run that has come to rest stays at its last instant.
  bool is_instant(double time, double step) const {
    constexpr double kRounding = 1e-9;  // rounding in sums of steps [s]
    return (rests_ && time > time_.back()) ||
           std::abs(time_[nearest(time)] - time) <= (step + step_) / 2 + kRounding;
  }

  // Returns the curvature on a straight line between two instants of a run that all but rests [1/m]: one
  // whose curvature changes by less than 1/m, root mean square, from one to the other.
  std::optional<std::vector<float>> between_instants(const ClothMesh& mesh, double time) const {
    constexpr double kStill = 1;  // [1/m]
    const std::size_t after = first_after(time);
    if (after == 0 || after == time_.size()) return std::nullopt;
    std::vector<float> curvature = curvature_in(mesh, after - 1), change = curvature_in(mesh, after);
    std::ranges::transform(change, curvature, change.begin(), std::minus<>());
    if (root_mean_square(change, mesh.vertex_area) >= kStill) return std::nullopt;
    const auto part = static_cast<float>((time - time_[after - 1]) / (time_[after] - time_[after - 1]));
    for (std::size_t i = 0; i < curvature.size(); ++i) curvature[i] += part * change[i];
    return curvature;
  }

  std::size_t first_after(double time) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(time_, time) - time_.begin());
  }

  std::size_t nearest(double time) const {
    const auto found = std::ranges::min_element(time_, {}, [&](double t) { return std::abs(t - time); });
    return static_cast<std::size_t>(found - time_.begin());
  }

  std::vector<float> curvature_in(const ClothMesh& mesh, std::size_t instant) const {
    const Surface surface = read_surface((folder_ / "mesh" / fmt::format("{:04}.ply", instant)).string());
    if (surface.face != mesh.face || surface.curvature.size() != mesh.rest.size())
      throw refusal(fmt::format("has other triangles than this cloth ({} and {}): run it with the same mesh",
                                surface.face.size(), mesh.face.size()));
    return {surface.curvature.begin(), surface.curvature.end()};
  }

  Error refusal(const std::string& why) const {
    return Error::invalid_input("reference = " + folder_.string() + " " + why + " (--reference)")
        .with_key("reference", folder_.string());
  }

  fs::path folder_;
  std::vector<double> time_;  // times of its instants [s]
  double step_ = 0;           // its time step [s]; 0: unknown
  bool rests_ = false;        // it has ended at rest
};

class SimulatedSubject : public FrameSource {
 public:
  SimulatedSubject(const Scene& scene, const Cloth& cloth, Simulation& simulation,
                   const std::string& reference)
      : cloth_(cloth),
        simulation_(simulation),
        mesh_(drawn_mesh(cloth.mesh, scene.cloth)),
        step_(scene.step) {
    if (!reference.empty()) reference_.emplace(reference);
  }

  const DrawnMesh& mesh() const override { return mesh_; }
  double time() const override { return simulation_.time(); }
  std::vector<float> positions() override { return flat_points(simulation_.positions()); }
  std::vector<float> values(const std::string& look) override {
    const int d = simulation_.dimension();
    if (look == "residual") return vertex_curvature(cloth_.mesh, simulation_.residual_curvature(), d);
    if (look == "height") return heights(positions());
    if (look == "friction") return vertex_average(cloth_.mesh, simulation_.friction_share(), d);
    if (look != "curvature" && look != "difference") return {};
    std::vector<float> curvature = vertex_curvature(cloth_.mesh, simulation_.curvature(), d);
    if (look == "curvature") return curvature;
    const auto other = reference_->curvature(cloth_.mesh, simulation_.time(), step_);
    if (!other) return std::vector<float>(curvature.size(), 0);
    std::transform(curvature.begin(), curvature.end(), other->begin(), curvature.begin(), std::minus<>());
    return curvature;
  }
  bool has_values(const std::string& look) const override {
    return look != "difference" || reference_->has_instant(cloth_.mesh, simulation_.time(), step_);
  }
  std::vector<double> vertex_areas() const override { return cloth_.mesh.vertex_area; }
  int cuda_device() const override { return simulation_.cuda_device(); }
  std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                               std::string& reason) override {
    return simulation_.share_positions(gl_buffer, gl_device, reason);
  }

 private:
  const Cloth& cloth_;
  Simulation& simulation_;
  DrawnMesh mesh_;
  double step_;  // [s]
  std::optional<ReferenceRun> reference_;
};

}  // namespace

std::vector<float> pattern_coordinates(const ClothMesh& mesh, const ClothShape& shape) {
  std::vector<float> uv;
  if (mesh.sewn) return uv;
  if (shape.shape == ClothOutline::tube) {
    for (const Eigen::Vector2d& p : unrolled_tube(mesh, shape))
      uv.insert(uv.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    return uv;
  }
  const Eigen::Vector3d weft = Eigen::Vector3d::UnitZ().cross(mesh.warp_axis);
  for (int i = 0; i < mesh.vertices(); ++i) {
    Eigen::Vector3d at = mesh.rest[i];
    if (!mesh.pattern.empty()) at << mesh.pattern[i], 0;
    uv.push_back(static_cast<float>(at.dot(mesh.warp_axis)));
    uv.push_back(static_cast<float>(at.dot(weft)));
  }
  return uv;
}

DrawnMesh drawn_mesh(const ClothMesh& mesh, const ClothShape& shape) {
  DrawnMesh drawn{mesh.rest.size(), flat_triangles(mesh.face), pattern_coordinates(mesh, shape),
                  mesh.mean_edge_length() / kStepsAnEdge};
  drawn.pattern = rounded(drawn.pattern, drawn.quantum);
  return drawn;
}

std::vector<double> vertex_areas(const std::vector<int>& triangles, const std::vector<float>& xyz) {
  const auto point = [&](int vertex) {
    const float* x = &xyz[3 * static_cast<std::size_t>(vertex)];
    return Eigen::Vector3d(x[0], x[1], x[2]);
  };
  std::vector<double> area(xyz.size() / 3, 0);
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Eigen::Vector3d a = point(triangles[t]);
    const double whole = (point(triangles[t + 1]) - a).cross(point(triangles[t + 2]) - a).norm() / 2;
    for (std::size_t k = 0; k < 3; ++k) area[triangles[t + k]] += whole / 3;
  }
  return area;
}

void check_reference(const std::string& reference, const ClothMesh& mesh, const ClothShape& shape) {
  if (!reference.empty()) ReferenceRun(reference).check(mesh, shape);
}

std::unique_ptr<FrameSource> simulated(const Scene& scene, const Cloth& cloth, Simulation& simulation,
                                       const std::string& reference) {
  return std::make_unique<SimulatedSubject>(scene, cloth, simulation, reference);
}

std::vector<float> shape_curvature(const std::vector<float>& xyz, const std::vector<int>& triangles) {
  std::vector<Eigen::Vector3d> x;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) x.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  std::vector<Eigen::Vector3i> face;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    face.emplace_back(triangles[i], triangles[i + 1], triangles[i + 2]);
  return surface_curvature(x, face, "kept geometry");
}

std::vector<float> ArchivedSource::values(const std::string& look) {
  const ArchivedState& instant = instants_[now_];
  if (const auto kept = instant.values.find(look); kept != instant.values.end()) return kept->second;
  if (look == "height") return heights(instant.xyz);
  if (look == "residual" || look == "friction" || look == "difference")
    throw Error::invalid_input("look = " + look + " needs values that were not kept: run with --look " +
                               look + " (--look)")
        .with_key("look", look);
  if (look != "curvature") return {};
  return shape_curvature(instant.xyz, mesh_.triangles);
}

}  // namespace hysteron::experiments
