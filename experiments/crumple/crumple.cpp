// `hysteron crumple`: a sheet or a tube is crushed, opened, spread and hung, and keeps wrinkles (as the
// chapter's Figure 4.1).  With `--law all`, or several laws separated by commas, it compares them on one
// page.  The scene's file defines the motion: crumple-sphere, crumple-table, crumple-fist, crumple-knot, or
// one's own.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/case.h"
#include "experiments/workbench/pictures/ridge_metrics.h"
#include "experiments/workbench/session/metric_request.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/session.h"
#include "experiments/workbench/session/variant_page.h"
#include "sim/base/csv.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/motion.h"

namespace hysteron::experiments {
namespace {

struct CrumpleParams {
  double ridge = 20;
};
using C = CrumpleParams;
// clang-format off
const KeyRow<C> kRows[] = {
    {"crumple.ridge", at<&C::ridge>, "1/m", positive(), "residual curvature from which a place counts as part of a ridge"},
};
// clang-format on

constexpr int kQuickTriangles = 1500;
constexpr double kQuickFps = 10;
constexpr int kBins = 40;           // bins of the histogram of curvatures, up to two K0
constexpr float kHeadroom = 0.12f;  // share of the picture above the cloth, for the caption

Setup defaults() {
  Setup setup;
  setup.scene = default_scene();
  setup.options.scene = "crumple-sphere";
  setup.options.fps = 25;
  setup.options.camera_direction = {0.25, -1.0, 0.15};
  setup.options.camera_fov = 24;
  setup.own_tables = {"metric"};
  return setup;
}

struct RidgeMetrics {
  double ridges = 0;     // total length [m]
  double curvature = 0;  // root mean square over the area [1/m]
  double residual = 0;   // root mean square of the curvature without load [1/m]
};

RidgeMetrics measured_ridges(Session& session, const C& choice) {
  const ClothMesh& mesh = session.cloth().mesh;
  Simulation& simulation = session.simulation();
  const int d = simulation.dimension();
  const std::vector<double> size = curvature_size(simulation.residual_curvature(), d);
  const std::vector<double> area = element_areas(mesh, d);
  return {ridge_length(mesh, vertex_average(mesh, size, d), choice.ridge),
          curvature_rms(simulation.curvature(), area, d), curvature_rms(size, area, d)};
}

// Returns the lowest point that the cloth can reach when it finally hangs from its only pin.
Eigen::Vector3d lowest_hanging(const Scene& scene, const Cloth& cloth) {
  const Eigen::Vector3d& held = cloth.start[cloth.pin_vertices[0].front()];
  double reach = 0;
  for (const Eigen::Vector3d& x : cloth.start) reach = std::max(reach, (x - held).norm());
  return placement(scene.pin[0].motion, scene.seconds)(held) + reach * scene.gravity.stableNormalized();
}

// Returns the bounds of the cloth at the start and along the motion of its pins.
render::Box box_of_motion(const Scene& scene, const Cloth& cloth) {
  render::Box box;
  box.low = box.high = cloth.start[0].cast<float>();
  const auto include = [&](const Eigen::Vector3d& x) {
    box.low = box.low.cwiseMin(x.cast<float>());
    box.high = box.high.cwiseMax(x.cast<float>());
  };
  for (const Eigen::Vector3d& x : cloth.start) include(x);
  for (std::size_t p = 0; p < scene.pin.size(); ++p) {
    if (scene.pin[p].from > 0) continue;
    for (const Keyframe& key : scene.pin[p].motion.keys)
      for (int i : cloth.pin_vertices[p]) include(cloth.start[i] + key.position);
  }
  if (scene.pin.size() == 1 && scene.pin[0].from == 0) include(lowest_hanging(scene, cloth));
  box.high.z() += kHeadroom * (box.high.z() - box.low.z());
  return box;
}

// Writes residual.csv: the share of the area by residual curvature.
void write_histogram(Session& session) {
  const int dimension = session.simulation().dimension();
  const std::vector<double> area = element_areas(session.cloth().mesh, dimension);
  const double bin = 2 * session.scene().fabric.friction_curvature() / kBins;
  const std::vector<double> fraction =
      area_fractions(curvature_size(session.simulation().residual_curvature(), dimension), area, bin, kBins);
  Table table("residual_curvature [1/m],share [%]");
  for (int k = 0; k < kBins; ++k) table.row({(k + 0.5) * bin, fraction[k] > 0 ? 100 * fraction[k] : NAN});
  table.write(session.run().path("residual.csv"));
}

std::vector<TablePlot> ridge_plots(const std::string& title) {
  return {{"plot_residual",
           {title, {"norm of the residual curvature [1/m]"}, {"share of the area per bin [%]", true}},
           "residual.csv",
           "residual_curvature",
           "share"},
          {"plot_curvature",
           {title, {"time [s]"}, {"curvature, root mean square [1/m]"}},
           "metrics.csv",
           "time",
           "curvature_rms"}};
}

std::string fold_caption(double curvature, double residual) {
  return fmt::format("curvature {:.1f} 1/m, residual {:.1f} 1/m", curvature, residual);
}

void draw_all(Session& session, const RidgeMetrics& wrinkles) {
  Pictures& pictures = *session.pictures();
  const Scene& scene = session.scene();
  const std::string caption =
      scene.fabric.name + ", law " + scene.law + ": " + fold_caption(wrinkles.curvature, wrinkles.residual);
  for (const char* look : {"curvature", "residual"})
    pictures.picture_file(session.run().path(std::string(look) + ".png"), look, caption);
  pictures.set_light(Lighting::raking);
  pictures.picture_file(session.run().path("raking.png"), "cloth", caption);
  for (const TablePlot& plot : ridge_plots(scene.fabric.name)) draw(session.run(), plot, scene.law);
}

void limit_to_quick(Setup& setup) {
  setup.scene.triangles = std::min(setup.scene.triangles, kQuickTriangles);
  setup.options.fps = std::min(setup.options.fps, kQuickFps);
}

class CrumpleCase : public Case {
 public:
  explicit CrumpleCase(const CommandLine& line);
  RunPlan plan(Session& session) override;
  void conclude(Session& session) override;

 private:
  C choice_;
  RidgeMetrics wrinkles_;  // at the last instant of --fps
};

CrumpleCase::CrumpleCase(const CommandLine& line) {
  setup = set_up(line, defaults(), bind(kRows, choice_), limit_to_quick);
  if (const ClothShape& cloth = setup.scene.cloth; cloth.is_rectangle() && rest_file(setup.scene).empty())
    probe_unless_told(setup.options, {cloth.length / 2, cloth.side_along_weft() / 2});
}

RunPlan CrumpleCase::plan(Session& session) {
  session.reserve({"residual.csv"},
                  {"curvature.png", "residual.png", "raking.png", "plot_residual", "plot_curvature"});
  RunPlan plan;
  plan.title = "Crumpled: " + setup.scene.fabric.name + ", law " + setup.scene.law;
  plan.columns = {"ridge_length [m]", "curvature_rms [1/m]", "residual_curvature_rms [1/m]"};
  plan.measure = [this, &session](const Snapshot&) -> std::vector<double> {
    wrinkles_ = measured_ridges(session, choice_);
    return {wrinkles_.ridges, wrinkles_.curvature, wrinkles_.residual};
  };
  plan.progress = [this](const Snapshot& m) {
    return fmt::format("t = {:.3f} s  {}  residual curvature {:.1f} 1/m  ridges {:.2f} m", m.time,
                       setup.scene.phase_at(m.time), wrinkles_.residual, wrinkles_.ridges);
  };
  return plan;
}

void CrumpleCase::conclude(Session& session) {
  session.run().metric("ridge_length_m", wrinkles_.ridges);
  session.run().metric("curvature_rms_per_m", wrinkles_.curvature);
  write_histogram(session);
  if (session.pictures()) draw_all(session, wrinkles_);
}

VariantPage variants_page(const CommandLine& line, std::vector<Variant>&) {
  C choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice));
  take_requests(setup);
  std::vector<std::string> metrics = {"residual_curvature_rms_per_m", "ridge_length_m", "curvature_rms_per_m",
                                      "intersections"};
  std::ranges::copy(setup.requested_metrics, std::back_inserter(metrics));
  return {"Crumpled", setup, to_json(bind(kRows, choice)), metrics, ridge_plots(""), "raking.png"};
}

}  // namespace

Experiment crumple() {
  return {
      .name = "crumple",
      .question = "crushed, opened, spread and hung: wrinkles that stay",
      .case_of = case_of<CrumpleCase>,
      .simulates = true,
      .own_keys = own_key_descriptions<kRows, page_keys>,
      .defaults = defaults,
      .frame = box_of_motion,
      .page = variants_page,
      .compared = true,
      .by_chance = true,
      .headlines = {.all = {{"residual_curvature_rms_per_m", "residual curvature (rms)", "1/m", "{:.4g}"},
                            {"ridge_length_m", "length of ridges", "mm", "{:.1f}", 1e3},
                            {"curvature_rms_per_m", "curvature (rms)", "1/m", "{:.4g}"},
                            {"intersections", "pairs of triangles that cross", "", "{:.0f}", 1, kNoErrors}}}};
}

}  // namespace hysteron::experiments
