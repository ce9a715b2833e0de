// The observers of every run, except those with a file of their own.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/integrator_texts.h"
#include "experiments/workbench/compare/errors.h"
#include "experiments/workbench/pages/closing_summary.h"
#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/session/animation_export.h"
#include "experiments/workbench/session/intersection_count.h"
#include "experiments/workbench/session/mesh_export.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/recoveries.h"
#include "experiments/workbench/session/resuming.h"
#include "experiments/workbench/session/run_warnings.h"
#include "sim/bending/curvature_operator.h"
#include "sim/bending/facet_tilt.h"
#include "sim/contact/compression.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kMetricsFile = "metrics.csv";

// Writes metrics.csv: time, speed, the experiment's own columns, the ledger.
class Series : public Observer {
 public:
  void begin(Session& session) override {
    std::vector<std::string> columns = {"time [s]", "fastest [m/s]"};
    const std::vector<std::string>& own = session.plan().columns;
    columns.insert(columns.end(), own.begin(), own.end());
    for (const auto& [name, joules] : Ledger{}.rows()) columns.push_back(name + " [J]");
    rows_.emplace(session.run().path(kMetricsFile), columns);
    session.run().manifest().series = own;
  }
  void record(Session& session, const Snapshot& instant) override {
    std::vector<double> row = {instant.time, instant.fastest};
    for (double value : session.plan().measure(instant)) row.push_back(value);
    for (const auto& [name, joules] : session.simulation().ledger().rows()) row.push_back(joules);
    rows_->row(row);
  }
  void close() override { rows_->finish(); }
  void serialise(Archive& archive) override { rows_->serialise(archive); }

 private:
  std::optional<TimeSeriesWriter> rows_;
};

// Draws frames with the loop of a probe, the contact sheet, and the plots of probes.
class Drawing : public Observer {
 public:
  explicit Drawing(const Probes& probes) : probes_(probes) {}
  void begin(Session& session) override {
    run_ = &session.run();
    auto pictures = std::make_unique<Pictures>(session.setup(), session.cloth(), session.simulation(),
                                               session.bounds(), session.plan().floor);
    pictures_ = pictures.get();
    session.draw_by(std::move(pictures));
    run_->progress("pictures: " + pictures_->renderer() + "; positions: " + pictures_->positions_route());
  }
  void record(Session& session, const Snapshot& instant) override {
    if (session.is_pictured(instant)) pictures_->frame(*run_, flat_points(instant.x), probes_.loop());
  }
  void finish(Session& session, const std::string& title) override {
    const std::string rest_warning = not_at_rest_warning(run_->metrics());
    pictures_->finish(*run_, title + (rest_warning.empty() ? "" : ". " + rest_warning));
    probes_.plot(*run_, session.scene().fabric.name + ", law " + session.scene().law);
  }
  void serialise(Archive& archive) override { pictures_->serialise(archive, *run_); }

 private:
  const Probes& probes_;
  Run* run_ = nullptr;
  Pictures* pictures_ = nullptr;
};

// Records the solver's statistics: energies, convergence, largest stretch.
class SolverStats : public Observer {
 public:
  void begin(Session& session) override;
  void watch(Session& session, const Snapshot&) override {
    stretched_ = std::max(stretched_, session.simulation().largest_stretch());
  }
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override { archive(stretched_); }

 private:
  double stretched_ = 0;  // largest principal stretch minus 1 over the watched instants
};

void SolverStats::begin(Session& session) {
  const Options& options = session.setup().options;
  const MeshFormat format = options.export_format;
  const bool draws = !options.no_images || format == MeshFormat::pc2 || AnimationExport::writes(format);
  const std::string warning = drawing_text(session.scene(), session.cloth());
  if (draws && !warning.empty()) session.run().warn(warning);
}

// Records launches and waits per step, except in a batch, whose runs share them.
void note_device_work(Run& run, const Diagnostics& counts) {
  if (run.manifest().batch) return;
  run.note("device_per_step", {{"launches", counts.per_step(counts.device.loops)},
                               {"synchronizations", counts.per_step(counts.device.synchronizations)},
                               {"allocations", counts.per_step(counts.device.allocations)}});
}

void fill_manifest(Run& run, Simulation& simulation, const Diagnostics& counts) {
  Manifest& manifest = run.manifest();
  for (const auto& [stage, seconds] : simulation.stage_seconds()) run.add_seconds(stage, seconds);
  manifest.state_hash = fmt::format("{:016x}", simulation.state_hash());
  manifest.steps = counts.steps;
  manifest.seconds_simulated = simulation.time();
  manifest.bytes_device = counts.bytes;
  note_device_work(run, counts);
}

// Records the energy balance.  In statics the integrator's share is the energy released by jumps from one
// equilibrium to the next, whatever the step, and the second-order error of the mean of the forces.
void note_energy(Run& run, const Ledger& ledger, const Scene& scene) {
  run.manifest().energy = ledger.rows();
  const double fraction = ledger.integrator_share();
  run.metric("energy_remainder_relative", ledger.remainder_relative);
  run.metric("integrator_share_percent", 100 * fraction);
  if (scene.integrator == Integrator::quasi_static) return;
  const std::string warning = integrator_text(ledger, scene.step);
  if (!warning.empty()) run.warn(warning);
}

// Records how much was left unbalanced, in the units of --newton-residual and --newton-velocity.
void note_convergence(Run& run, const Diagnostics& counts, const Scene& scene) {
  run.metric("solver_iterations_per_step", counts.per_step(counts.linear));
  if (scene.finds_equilibrium()) {
    run.metric("newton_iterations_per_step", counts.per_step(counts.newton));
    if (scene.is_implicit()) {
      run.metric("newton_residual_largest", counts.largest_residual);
      run.metric("newton_velocity_largest_m_per_s", counts.largest_velocity);
      run.metric("newton_velocity_mean_m_per_s", counts.mean_velocity());
    }
    if (scene.newton_iterations > 0 || counts.unbalanced > 0)
      run.metric("unbalanced_steps_count", counts.unbalanced);
    constexpr double kFew = 0.05;
    const long all = std::max(counts.steps, counts.parts);
    if (static_cast<double>(counts.unbalanced) > kFew * static_cast<double>(all))
      run.warn(
          fmt::format("{} of {} steps were taken with forces out of balance: newton-iterations = {} was not "
                      "enough for them",
                      counts.unbalanced, all, scene.newton_iterations));
  }
  if (scene.finds_equilibrium() || scene.tolerance > 0) {
    run.metric("parts_count", counts.parts);
    run.metric("retried_steps_count", counts.retried);
  }
}

void note_pinch(Run& run, const Diagnostics& counts) {
  if (counts.pinched == 0) return;
  run.metric("pinched_steps_count", counts.pinched);
  run.metric("pinch_depth_m", counts.pinch_depth);
  run.warn(
      fmt::format("in {} parts of steps solids pinched the cloth harder than they bear, {:.0f} kPa, and gave "
                  "way by up to {:.2g} mm: leave it more room where that matters",
                  counts.pinched, 1e-3 * kYieldPressure, 1e3 * counts.pinch_depth));
}

void note_deep_contact(Run& run, const Diagnostics& counts) {
  run.metric("deep_contact_steps_count", counts.deep);
  note_pinch(run, counts);
  if (counts.deep == 0) return;
  run.warn("in " + std::to_string(counts.deep) +
           " parts of steps the cloth was in an obstacle: a larger contact-stiffness or a shorter step "
           "keeps it out");
}

void note_saturated_pins(Run& run, const Diagnostics& counts, const Scene& scene) {
  const long blocked = counts.blocked_pins;
  const bool weak =
      std::any_of(scene.pin.begin(), scene.pin.end(), [](const Pin& p) { return p.strength > 0; });
  if (!weak && blocked == 0) return;
  run.metric("slack_hand_steps_count", counts.saturated_pins);
  run.metric("hand_lag_m", counts.pin_lag);
  if (blocked == 0) return;
  run.metric("barred_hand_steps_count", blocked);
  run.warn(
      fmt::format("in {} parts of steps cloth barred the way of rigid pins, which gave way: what they hold "
                  "lagged behind by up to {:.2g} mm",
                  blocked, 1e3 * counts.pin_lag));
}

void SolverStats::finish(Session& session, const std::string&) {
  Run& run = session.run();
  Simulation& simulation = session.simulation();
  const Scene& scene = session.scene();
  const Diagnostics counts = simulation.counts();
  fill_manifest(run, simulation, counts);
  run.metric("max_stretch_percent", 100 * simulation.largest_stretch());
  note_energy(run, simulation.ledger(), scene);
  for (const std::string& warning :
       warnings_at_end(scene, session.cloth(), simulation.positions(), stretched_))
    run.warn(warning);
  note_convergence(run, counts, scene);
  if (!scene.obstacle.empty()) note_deep_contact(run, counts);
  note_saturated_pins(run, counts, scene);
}

// Counts what is sharply folded for the size of its triangles.
class SharpFolds : public Observer {
 public:
  explicit SharpFolds(const ClothMesh& mesh) : mesh_(mesh), rest_angle_(rest_angles(mesh)), tilt_(mesh) {}
  void watch(Session&, const Snapshot& instant) override {
    std::vector<double> bent = hinge_angles(mesh_, instant.x);
    for (std::size_t e = 0; e < bent.size(); ++e) bent[e] -= rest_angle_[e];
    edges_ = std::max(
        edges_,
        share(std::ranges::count_if(bent, [](double a) { return std::abs(a) > kSharp; }), bent.size()));
    const std::vector<double> tilt = tilt_.tilts(bent);
    triangles_ = std::max(
        triangles_, share(std::ranges::count_if(tilt, [](double t) { return t > kTilted; }), tilt.size()));
  }
  void finish(Session& session, const std::string&) override {
    constexpr double kMany = 0.01;
    session.run().metric("sharp_edges_percent", 100 * edges_);
    session.run().metric("tilted_triangles_percent", 100 * triangles_);
    if (triangles_ < kMany) return;
    session.run().warn(
        fmt::format("up to {:.1f} % of the triangles were coarse for their fold: tilted along it by more "
                    "than {:.1f} rad, "
                    "they bend wrong by some percent; take more triangles",
                    100 * triangles_, kTilted));
  }
  void serialise(Archive& archive) override { archive(edges_, triangles_); }

 private:
  static constexpr double kSharp = 0.5;   // angle of an edge [rad]
  static constexpr double kTilted = 0.2;  // where bending of held vertices is 2.7 % too soft [rad]

  static double share(std::size_t part, std::size_t all) {
    return static_cast<double>(part) / std::max<std::size_t>(1, all);
  }

  const ClothMesh& mesh_;
  std::vector<double> rest_angle_;
  FacetTilt tilt_;
  double edges_ = 0, triangles_ = 0;  // largest shares of sharply folded edges and of tilted triangles
};

// Measures errors (--errors) by running again, when all results for comparison are known.
class MeasuredErrors : public Observer {
 public:
  void finish(Session& session, const std::string&) override {
    session.run().path("report.html");
    if (session.setup().options.errors) measure_errors(session.run(), session.line(), session.setup());
  }
};

}  // namespace

Observers session_observers(Session& session, std::unique_ptr<Probes> probes,
                            std::unique_ptr<Checkpoints> checkpoints) {
  const Options& options = session.setup().options;
  const ClothMesh& mesh = session.cloth().mesh;
  session.reserve({kMetricsFile}, picture_files(options));
  session.reserve(probes->files(), probes->plots());
  const bool animates = AnimationExport::writes(options.export_format);
  session.reserve(animates ? AnimationExport::files(options.export_format)
                           : MeshExport::files(options.export_format));
  if (options.errors) session.reserve({"errors.csv"});
  Observers all;
  all.push_back(std::make_unique<Series>());
  const Probes& loops = *probes;
  all.push_back(std::move(probes));
  if (!options.no_images) all.push_back(std::make_unique<Drawing>(loops));
  all.push_back(std::make_unique<SolverStats>());
  if (options.check_intersections || session.scene().self_contact)
    all.push_back(
        std::make_unique<IntersectionCount>(mesh.face, session.simulation().cuda_device() >= 0,
                                            [&](const std::string& text) { session.run().warn(text); }));
  all.push_back(std::make_unique<SharpFolds>(mesh));
  all.push_back(std::make_unique<Recoveries>(session.scene()));
  if (!animates) all.push_back(std::make_unique<MeshExport>());
  all.push_back(std::make_unique<MeasuredErrors>());
  if (animates) all.push_back(std::make_unique<AnimationExport>());
  all.push_back(std::move(checkpoints));
  return all;
}

}  // namespace hysteron::experiments
