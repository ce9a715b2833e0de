#include "experiments/workbench/session/session.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/decided_keys.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/app/time_left.h"
#include "experiments/workbench/compare/errors.h"
#include "experiments/workbench/pages/closing_words.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pages/simulated_run.h"
#include "experiments/workbench/pictures/framing.h"
#include "experiments/workbench/session/doubts.h"
#include "experiments/workbench/session/planned_scene.h"
#include "experiments/workbench/session/resting.h"
#include "sim/bending/curvature_operator.h"
#include "sim/bending/laws/recovery.h"

namespace hysteron::experiments {
namespace {

// Steps between two recorded instants; at least one.
int steps_per_frame(const Setup& setup) {
  return std::max(1, static_cast<int>(std::lround(1 / (setup.options.fps * setup.scene.step))));
}

double fastest(const std::vector<Eigen::Vector3d>& now, const std::vector<Eigen::Vector3d>& before,
               double dt) {
  return farthest_moved(now, before) / dt;
}

std::vector<std::string> ledger_columns() {
  std::vector<std::string> columns;
  for (const auto& [name, joules] : Ledger{}.rows()) columns.push_back(name + " [J]");
  return columns;
}

// Elements by how far they were bent before they were let go, and the curvature they would keep if let go
// now: found on the law, and by the closed form for a first reversal from the virgin curve (which a longer
// history only resembles).
void note_recovery(Run& run, Simulation& simulation, const Scene& scene, const Recoveries& recoveries) {
  const LawChoice law = choose_law(scene.law, scene.fabric.virgin_curve(), scene.param);
  const int d = simulation.dimension();
  const std::vector<double> root = simulation.residual_curvature();
  double by_root = 0;
  for (double k : root) by_root += k * k;
  const double elements = static_cast<double>(root.size()) / d;
  run.metric("residual_curvature_rms_per_m", std::sqrt(by_root / elements));
  if (!recoveries.counts()) return;
  const std::vector<double> k = simulation.curvature(), m = simulation.moment();
  const std::array<long, 3> cases = recoveries.cases();
  double by_formula = 0;
  for (std::size_t i = 0; i < k.size(); i += d) {
    const Eigen::Map<const Eigen::VectorXd> curvature(&k[i], d), moment(&m[i], d);
    const double size = curvature.norm(), along = size > 0 ? moment.dot(curvature) / size : 0;
    by_formula += std::pow(residual_by_formula(law, size, std::max(along, 0.0)), 2);
  }
  run.metric("recovery_elastic_count", cases[0]);
  run.metric("recovery_partial_count", cases[1]);
  run.metric("recovery_full_slip_count", cases[2]);
  run.metric("residual_curvature_formula_rms_per_m", std::sqrt(by_formula / elements));
}

const Setup& checked(const Setup& setup) {
  check_duration(setup.scene);
  return setup;
}

}  // namespace

void explain(const Cloth& cloth, const Simulation& simulation) {
  std::cout << cloth.mesh.faces() << " triangles, " << cloth.mesh.interior_edges << " hinges, "
            << cloth.mesh.vertices() << " vertices on " << simulation.device() << "\n";
  for (const std::string& warning : cloth.warnings) std::cout << "warning: " << warning << "\n";
  const MethodChoice& method = simulation.method;
  if (!method.reason.empty()) std::cout << method.reason << "\n";
  if (method.linear_solver != Preconditioning::automatic)
    std::cout << "linear solver " << name_of(method.linear_solver) << (method.in_float ? " in float" : "")
              << "\n";
  const StepLimits limits = simulation.limits();
  std::cout << "substeps " << limits.substeps << " of " << limits.substep << " s";
  if (limits.bending_step > 0)
    std::cout << "; largest stable explicit bending step " << limits.bending_step << " s";
  std::cout << "\n";
  std::size_t total = 0;
  for (const ScenePart& part : simulation.parts()) {
    std::cout << fmt::format("{:<16} {:<3} {:12} bytes  {}\n", part.name, part.included ? "in" : "out",
                             part.bytes, part.included ? part.kernels : part.reason);
    total += part.bytes;
  }
  std::cout << "in all " << total << " bytes, " << static_cast<double>(total) / cloth.mesh.faces()
            << " per triangle" << std::endl;
}

namespace {
thread_local std::optional<Scene>* planned = nullptr;  // what planned_scene() waits for

struct Planning {
  explicit Planning(std::optional<Scene>& scene) { planned = &scene; }
  ~Planning() { planned = nullptr; }
};
}  // namespace

std::optional<Scene> planned_scene(CommandLine line) {
  std::optional<Scene> scene;
  const Planning planning(scene);
  line.flags.push_back({"explain", "true"});
  experiment_named(line.experiment).run(line);
  return scene;
}

Session::Session(const CommandLine& line, const Setup& setup, std::optional<Cloth> cloth)
    : line_(line),
      setup_(checked(setup)),
      cloth_(cloth ? std::move(*cloth) : make_cloth(setup.scene)),
      simulation_(make_simulation(setup.scene, cloth_)),
      rest_angle_(rest_angles(cloth_.mesh)),
      probes_(setup.options.probe, cloth_.mesh, simulation_->dimension()),
      recoveries_(setup.scene) {
  if (planned) {
    *planned = setup.scene;
    return;
  }
  if (setup.options.explain) {
    explain(cloth_, *simulation_);
    std::cout << probes_.text() << std::flush;
    return;
  }
  if (!setup.options.dump_scene.empty()) {
    dump_scene(setup);
    return;
  }
  if (setup.options.resume) check_existing_run();
  if (is_complete_) return;
  run_ = std::make_unique<Run>(line, setup, kept_files());
  run_->begun_at(begun_);
  Manifest& manifest = run_->manifest();
  manifest.device = simulation_->device();
  manifest.triangles = cloth_.mesh.faces();
  manifest.hinges = cloth_.mesh.interior_edges;
  manifest.substeps = simulation_->limits().substeps;
  const MethodChoice& method = simulation_->method;
  if (method.linear_solver != Preconditioning::automatic)
    manifest.linear_solver = name_of(method.linear_solver);
  if (!method.reason.empty()) run_->progress(method.reason);
  for (const std::string& warning : cloth_.warnings) run_->warn(warning);
  for (const std::string& doubt : doubts_at_start(setup_.scene, cloth_, *simulation_)) run_->warn(doubt);
  reserve({"metrics.csv"}, picture_files(setup_.options));
  reserve(probes_.files(), probes_.plots());
  reserve(MeshExport::files(setup_.options.export_format));
  if (setup_.options.errors) reserve({"errors.csv"});
  for (const std::string& words : lost_words(line, setup)) run_->warn(words);
  watch_crossings();
}

void Session::reserve(const std::vector<std::string>& files, const std::vector<std::string>& drawn) {
  run_->reserve(files);
  if (!setup_.options.no_images) run_->reserve(drawn);
}

// An edge folded by an angle of 0.25 is 0.6 % too soft in the `shape` element, by 0.5 2.5 %, by 1 9 %.
constexpr double kSharp = 0.5;

void Session::watch_folds(const std::vector<Eigen::Vector3d>& x) {
  const std::vector<double> angle = hinge_angles(cloth_.mesh, x);
  long sharp = 0;
  for (std::size_t e = 0; e < angle.size(); ++e) sharp += std::abs(angle[e] - rest_angle_[e]) > kSharp;
  folded_ = std::max(folded_, static_cast<double>(sharp) / std::max<std::size_t>(1, angle.size()));
}

void Session::watch_crossings() {
  if (!setup_.options.check_intersections && !setup_.scene.self_contact) return;
  crossings_ = std::make_unique<Crossings>(cloth_.mesh.face, simulation_->cuda_device() >= 0,
                                           [this](const std::string& text) { run_->warn(text); });
}

void Session::see_crossings(const std::vector<Eigen::Vector3d>& x) {
  if (!crossings_) return;
  const auto stage = run_->stage("intersections");
  crossings_->see(simulation_->time(), x);
}

void Session::note_crossings() {
  if (!crossings_) return;
  const auto stage = run_->stage("intersections");
  run_->metric("intersections", crossings_->pairs());
}

void Session::note_folds() {
  constexpr double kMany = 0.01;
  run_->metric("sharp_edges_percent", 100 * folded_);
  if (folded_ < kMany) return;
  run_->warn(
      fmt::format("up to {:.1f} % of the edges were folded by more than {:.1f} rad, where bending is more "
                  "than 2.5 % too soft: take more triangles",
                  100 * folded_, kSharp));
}

// Of a batch the launches and waits are not one run's.
void Session::note_device_work() {
  if (run_->manifest().batch) return;
  const DeviceCounts work = simulation_->device_work();
  const auto per_step = [&](long count) {
    return static_cast<double>(count) / static_cast<double>(std::max(1L, simulation_->steps()));
  };
  run_->note("device_per_step", {{"launches", per_step(work.loops)},
                                 {"synchronizations", per_step(work.synchronizations)},
                                 {"allocations", per_step(work.allocations)}});
}

void Session::note_deep_contact() {
  const long deep = simulation_->deep_steps();
  run_->metric("deep_contact_steps_count", deep);
  if (deep == 0) return;
  run_->warn("in " + std::to_string(deep) +
             " parts of steps the cloth was in an obstacle: a larger contact-stiffness or a shorter step "
             "keeps it out");
}

void Session::note_slack_hands() {
  const std::vector<Pin>& pins = setup_.scene.pin;
  const long barred = simulation_->barred_hand_steps();
  const bool weak = std::any_of(pins.begin(), pins.end(), [](const Pin& pin) { return pin.strength > 0; });
  if (!weak && barred == 0) return;
  run_->metric("slack_hand_steps_count", simulation_->slack_hand_steps());
  run_->metric("hand_lag_m", simulation_->hand_lag());
  if (barred == 0) return;
  run_->metric("barred_hand_steps_count", barred);
  run_->warn(
      fmt::format("in {} parts of steps cloth barred the way of rigid pins, which gave way: what they hold "
                  "lagged behind by up to {:.2g} mm",
                  barred, 1e3 * simulation_->hand_lag()));
}

// How much was left unbalanced, in the units of --newton-residual and --newton-velocity.
void Session::note_convergence() {
  run_->metric("newton_iterations_per_step", simulation_->newton_iterations());
  const SolverCounts counts = simulation_->solver_counts();
  if (setup_.scene.is_implicit()) {
    run_->metric("newton_residual_largest", counts.largest_residual);
    run_->metric("newton_velocity_largest_m_per_s", counts.largest_velocity);
    run_->metric("newton_velocity_mean_m_per_s", counts.mean_velocity);
  }
  if (setup_.scene.newton_iterations > 0 || counts.unbalanced > 0)
    run_->metric("unbalanced_steps_count", counts.unbalanced);
}

// Of statics the share is what jumps from one equilibrium to the next set free, whatever the step, and what
// the mean of the forces misses, of second order in it.
void Session::note_integrator(const Ledger& ledger) {
  const double share = ledger.integrator_share();
  run_->metric("integrator_share_percent", 100 * share);
  if (setup_.scene.integrator == Integrator::quasi_static) return;
  const std::string doubt = integrator_words(share, setup_.scene.step);
  if (!doubt.empty()) run_->warn(doubt);
}

Snapshot Session::record(const RunPlan& question, Record& series, const std::vector<Eigen::Vector3d>& x,
                         double fastest, const std::string& left) {
  const Snapshot instant{simulation_->time(), x, fastest};
  std::vector<double> row = {instant.time, instant.fastest};
  for (double value : question.measure(instant)) row.push_back(value);
  for (const auto& [name, joules] : simulation_->ledger().rows()) row.push_back(joules);
  series.row(row);
  probes_.record(*simulation_, x);
  const bool pictured = !question.pictured || question.pictured(instant);
  if (pictures_ && pictured) pictures_->frame(*run_, x, probes_.loop());
  watch_folds(x);
  stretched_ = std::max(stretched_, simulation_->largest_stretch());
  recoveries_.see(*simulation_);
  see_crossings(x);
  if (pictured) meshes_.write(*run_, setup_.options.export_format, cloth_, *simulation_, x);
  run_->progress(question.progress(instant) + left);
  if (question.settled) run_->metric("fastest_m_per_s", instant.fastest);
  return instant;
}

// "cotton-broad, law prandtl, 6,000 triangles, 4 s in 480 steps on cpu"
std::string Session::opening_words(const RunPlan& question) const {
  const Scene& scene = setup_.scene;
  return scene.fabric.name + ", law " + scene.law + ", " + grouped(cloth_.mesh.faces()) + " triangles, " +
         number_text(scene.seconds) + " s in " + grouped(steps_of(question)) + " steps on " +
         simulation_->device();
}

long Session::steps_of(const RunPlan& question) const {
  return question.time_steps.empty() ? std::lround(setup_.scene.seconds / setup_.scene.step)
                                     : static_cast<long>(question.time_steps.size());
}

// Returns how far it is [s].
double Session::go_to_next_instant(const RunPlan& question) {
  const double step = setup_.scene.step;
  const long left = steps_of(question) - simulation_->steps();
  const int stride = static_cast<int>(std::min<long>(steps_per_frame(setup_), left));
  if (question.time_steps.empty()) {
    simulation_->advance(stride);
    return steps_per_frame(setup_) * step;
  }
  double passed = 0;
  double length = step;
  for (int s = 0; s < stride && length <= step; ++s) {
    length = question.time_steps[simulation_->steps()];
    length == step ? simulation_->advance(1) : simulation_->advance_by(length);
    passed += length;
  }
  return passed;
}

// All instants; those before a checkpoint have been recorded.  Returns whether the question is settled.
bool Session::run_to_end(const RunPlan& question, Record& series) {
  const long steps = steps_of(question);
  std::optional<Interrupts> interrupts;
  if (takes_checkpoints(question)) interrupts.emplace();
  const bool goes_on = go_on(question, series);
  std::vector<Eigen::Vector3d> before = simulation_->positions();
  const auto start = std::chrono::steady_clock::now();
  const long first_step = simulation_->steps();
  const auto look = [&](double passed) {
    const std::vector<Eigen::Vector3d> x = simulation_->positions();
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                 speed = fastest(x, before, passed);
    const long left = steps - first_step;
    const Snapshot instant =
        record(question, series, x, speed,
               time_left(simulation_->steps() - first_step, left, spent, !!question.settled));
    before = x;
    return question.settled && question.settled(instant);
  };
  if (!goes_on) look(setup_.scene.step);
  bool settled = false;
  while (!settled && simulation_->steps() < steps) {
    if (interrupts) pause(question, series, *interrupts);
    settled = look(go_to_next_instant(question));
  }
  return settled;
}

render::Box Session::framed(const RunPlan& question) {
  if (!question.wanders) return question.bounds;
  if (const Numbers& box = setup_.options.camera_box; !box.empty())
    return render::box_of(std::vector<float>(box.begin(), box.end()));
  const auto stage = run_->stage("framing");
  const Framing framing = framing_of(setup_, question.bounds);
  run_->progress(fmt::format("pictures frame what a run of {} triangles passes through", framing.triangles));
  if (!framing.stopped.empty())
    run_->warn("pictures frame what a coarse run passes through, which stopped: " + framing.stopped);
  return framing.box;
}

bool Session::simulate(const RunPlan& question) {
  run_->progress(opening_words(question));
  const bool staged = setup_.options.export_format == "mitsuba";
  const render::Box bounds = staged || !setup_.options.no_images ? framed(question) : question.bounds;
  if (staged) meshes_.stage(mitsuba_view(setup_, bounds, question.floor), setup_.scene);
  if (!setup_.options.no_images) {
    pictures_ = std::make_unique<Pictures>(setup_, cloth_, *simulation_, bounds, question.floor);
    run_->progress("pictures: " + pictures_->renderer() + "; positions: " + pictures_->positions_way());
  }
  const bool draws = pictures_ || setup_.options.export_format == "pc2";
  if (const std::string doubt = drawing_words(setup_.scene, cloth_); draws && !doubt.empty())
    run_->warn(doubt);
  std::vector<std::string> columns = {"time [s]", "fastest [m/s]"};
  columns.insert(columns.end(), question.columns.begin(), question.columns.end());
  const std::vector<std::string> energy = ledger_columns();
  columns.insert(columns.end(), energy.begin(), energy.end());
  Record series(run_->path("metrics.csv"), columns);
  run_->manifest().series = question.columns;
  probes_.begin(*run_);

  bool settled = run_to_end(question, series);
  if (question.to_rest && setup_.scene.is_implicit()) settled = find_rest(question, series);
  series.finish();
  probes_.finish();
  return settled;
}

void Session::finish(const std::string& title) {
  const std::string unrest = not_at_rest_warning(run_->metrics());
  if (pictures_) pictures_->finish(*run_, title + (unrest.empty() ? "" : ". " + unrest));
  if (pictures_) probes_.plot(*run_, setup_.scene.fabric.name + ", law " + setup_.scene.law);
  const Ledger ledger = simulation_->ledger();
  Manifest& manifest = run_->manifest();
  probes_.name_curves(manifest);
  manifest.energy = ledger.rows();
  for (const auto& [stage, seconds] : simulation_->stage_seconds()) run_->add_seconds(stage, seconds);
  manifest.state_hash = fmt::format("{:016x}", simulation_->state_hash());
  manifest.steps = simulation_->steps();
  manifest.seconds_simulated = simulation_->time();
  manifest.bytes_device = simulation_->device_bytes();
  note_device_work();
  run_->metric("max_stretch_percent", 100 * simulation_->largest_stretch());
  run_->metric("energy_remainder_relative", ledger.remainder_relative);
  note_integrator(ledger);
  for (const std::string& doubt : doubts_at_end(setup_.scene, cloth_, simulation_->positions(), stretched_))
    run_->warn(doubt);
  run_->metric("solver_iterations_per_step", simulation_->solver_iterations());
  if (setup_.scene.finds_equilibrium()) note_convergence();
  if (setup_.scene.finds_equilibrium() || setup_.scene.tolerance > 0) {
    run_->metric("parts_count", simulation_->parts_taken());
    run_->metric("retried_steps_count", simulation_->retried_steps());
  }
  if (!setup_.scene.obstacle.empty()) note_deep_contact();
  note_slack_hands();
  note_crossings();
  note_folds();
  note_recovery(*run_, *simulation_, setup_.scene, recoveries_);
  run_->path("report.html");
  if (setup_.options.errors) measure_errors(*run_, line_, setup_);
  drop_checkpoint();
  run_->finish();
  write_report(run_->folder());
}

}  // namespace hysteron::experiments
