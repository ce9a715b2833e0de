#include "experiments/workbench/session/session.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/framing.h"
#include "experiments/workbench/session/interrupts.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/resting.h"
#include "experiments/workbench/session/resuming.h"
#include "experiments/workbench/session/run_warnings.h"
#include "sim/base/number_in.h"
#include "sim/scene/body.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

// Returns the rate of watched instants [1/s], unless the experiment's plan sets another.
double default_rate(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  return experiment.defaults ? experiment.defaults().options.fps : Options{}.fps;
}

}  // namespace

Session::Session(const CommandLine& line, const Setup& setup, const Cloth& cloth, Simulation& simulation,
                 const std::vector<std::string>& kept)
    : line_(line), setup_(setup), cloth_(cloth), simulation_(simulation), run_(line, setup, kept) {
  describe_start();
}

void Session::observe(std::unique_ptr<Probes> probes, std::unique_ptr<Checkpoints> checkpoints) {
  observers_ = session_observers(*this, std::move(probes), std::move(checkpoints));
  for (const std::string& words : ignored_key_warnings(line_, setup_)) run_.warn(words);
  for (const std::string& warning : setup_.unread) run_.warn(warning);
  for (const std::string& warning : late_table_warnings(setup_.scene)) run_.warn(warning);
}

void Session::describe_start() {
  Manifest& manifest = run_.manifest();
  manifest.device = simulation_.device();
  manifest.triangles = cloth_.mesh.faces();
  manifest.hinges = cloth_.mesh.interior_edges;
  manifest.substeps = simulation_.limits().substeps;
  const MethodChoice& method = simulation_.method;
  if (method.linear_solver != Preconditioning::automatic)
    manifest.linear_solver = enum_name(method.linear_solver);
  if (!method.reason.empty()) run_.progress(method.reason);
  for (const std::string& warning : cloth_.warnings) run_.warn(warning);
  for (const std::string& warning : body_warnings(setup_.scene)) run_.warn(warning);
  warn_of_triangle_count();
  for (const std::string& warning : warnings_at_start(setup_.scene, cloth_, simulation_)) run_.warn(warning);
}

// Warns if the number of triangles differs from the request, except for a mesh file, and for a default
// number, which may be adapted.
void Session::warn_of_triangle_count() {
  if (!setup_.requested || !is_given(*setup_.requested, "triangles") || !rest_file(setup_.scene).empty())
    return;
  const Scene& requested = *setup_.requested;
  const std::string warning =
      triangle_count_warning(requested.triangles, key_origin(requested, "triangles"), cloth_.mesh.faces());
  if (!warning.empty()) run_.warn(warning);
}

void Session::plot(const std::string& name, render::Plot plot) {
  const auto says = [](const render::Series& series) {
    return series.label.find("simulated") != series.label.npos;
  };
  if (plot.note.empty() && std::ranges::none_of(plot.series, says)) plot.note = "simulated";
  run_.plot(name, plot);
}

void Session::reserve(const std::vector<std::string>& files, const std::vector<std::string>& drawn) {
  run_.reserve(files);
  if (!setup_.options.no_images) run_.reserve(drawn);
}

bool Session::watch(const Snapshot& instant) {
  if (plan_->watch) plan_->watch(instant);
  for (const auto& observer : observers_) observer->watch(*this, instant);
  if (!plan_->settled) return false;
  run_.metric("fastest_m_per_s", instant.fastest);
  return plan_->settled(instant);
}

void Session::record(const Snapshot& instant, const std::string& left) {
  for (const auto& observer : observers_) observer->record(*this, instant);
  run_.progress(plan_->progress(instant) + left);
}

// Returns "cotton-broad, law prandtl, 6,000 triangles, 4 s in 480 steps on cpu".
std::string Session::opening_text() const {
  const Scene& scene = setup_.scene;
  return scene.fabric.name + ", law " + scene.law + ", " + number_text(cloth_.mesh.faces(), kCount) +
         " triangles, " + number_text(scene.seconds) + " s in " + number_text(timetable_.steps(), kCount) +
         " steps on " + simulation_.device();
}

// Reports by how much instants of --fps deviate from their times.
void Session::note_rounded_instants() {
  constexpr double kNoticed = 1e-3;  // in steps
  const double fps = setup_.options.fps, step = setup_.scene.step;
  if (fps * step > 1 + kNoticed) {
    run_.progress(fmt::format(
        "fps = {:g} 1/s is more than the {:g} steps of a second: every step is recorded", fps, 1 / step));
    return;
  }
  const double shift = timetable_.largest_shift(fps);
  if (shift <= kNoticed * step) return;
  run_.note("instants_rounded_by_s", shift);
  run_.progress(
      fmt::format("instants of fps = {:g} 1/s are recorded at the ends of steps, up to {:.2g} s "
                  "beside their times; metrics.csv has the true ones",
                  fps, shift));
}

double Session::fastest_since(Before& before, const std::vector<Eigen::Vector3d>& x) const {
  const long now = simulation_.steps();
  const double moved = before.x.empty() ? 0 : farthest_moved(x, before.x);
  const double passed = now > before.step ? timetable_.between(before.step, now) : setup_.scene.step;
  before = {now, x};
  return moved / passed;
}

void Session::go_on() {
  const long now = simulation_.steps();
  long next = plan_->each_step ? now + 1
                               : std::min(timetable_.next_instant(now, setup_.options.fps),
                                          timetable_.next_instant(now, watch_rate_));
  for (const long due : instant_steps_)
    if (due > now) next = std::min(next, due);
  advance_along(timetable_, simulation_, next);
}

bool Session::look(const std::string& left) {
  const long now = simulation_.steps();
  const double time = simulation_.time();
  const std::vector<Eigen::Vector3d> x = simulation_.positions();
  if (plan_->each_step) plan_->each_step({time, x, NAN});
  for (std::size_t i = 0; i < instant_steps_.size(); ++i)
    if (instant_steps_[i] == now) plan_->instants[i].look({time, x, NAN});
  bool settled = false;
  if (timetable_.is_instant(now, watch_rate_)) settled = watch({time, x, fastest_since(watched_, x)});
  if (settled || timetable_.is_instant(now, setup_.options.fps))
    record({time, x, fastest_since(recorded_, x)}, left);
  return settled;
}

// Runs all instants; those before a checkpoint have been recorded.  Returns true if the question is settled.
bool Session::run_to_end() {
  std::optional<Interrupts> interrupts;
  if (setup_.options.checkpoint > 0) interrupts.emplace();
  for (const auto& observer : observers_) observer->begin(*this);
  const auto start = std::chrono::steady_clock::now();
  const long first_step = simulation_.steps(), steps = timetable_.steps(), left = steps - first_step;
  if (!has_begun_) look("");
  has_begun_ = true;
  bool settled = false;
  while (!settled && simulation_.steps() < steps) {
    for (const auto& observer : observers_) observer->step(*this);
    go_on();
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    settled = look(time_left(simulation_.steps() - first_step, left, spent, !!plan_->settled));
  }
  return settled;
}

render::Box Session::framed() {
  const Options& options = setup_.options;
  const auto frame = experiment_named(line_.experiment).frame;
  if (!frame) return plan_->bounds;
  const render::Box known = frame(setup_.scene, cloth_);
  if (!options.has_view()) return known;
  if (const Numbers& box = options.camera_box; !box.empty())
    return render::bounding_box(std::vector<float>(box.begin(), box.end()));
  const auto stage = run_.stage("framing");
  const Framing framing = scene_framing(setup_, known);
  run_.progress(fmt::format("pictures frame what a run of {} triangles passes through", framing.triangles));
  if (!framing.stopped.empty())
    run_.warn("pictures frame what a coarse run passes through, which stopped: " + framing.stopped);
  return framing.box;
}

void Session::simulate(const RunPlan& plan) {
  plan_ = &plan;
  const Scene& scene = setup_.scene;
  timetable_ =
      plan.time_steps.empty() ? Timetable(scene.seconds, scene.step) : Timetable(plan.time_steps, scene.step);
  watch_rate_ = plan.watch_rate > 0 ? plan.watch_rate : default_rate(line_);
  instant_steps_.clear();
  for (const RunPlan::Instant& instant : plan.instants)
    instant_steps_.push_back(timetable_.first_end(instant.time));
  run_.progress(opening_text());
  if (plan.time_steps.empty()) note_rounded_instants();
  bounds_ = framed();
  settled_ = run_to_end();
  if (plan.to_rest && setup_.scene.is_implicit()) settled_ = find_rest();
  for (const auto& observer : observers_) observer->close();
  plan_ = nullptr;
}

void Session::finish(const std::string& title) {
  for (const auto& observer : observers_) observer->finish(*this, title);
  finish_with_report(run_);
}

void Session::serialise(Archive& archive) {
  run_.serialise(archive);
  archive(has_begun_);
  for (Before* before : {&recorded_, &watched_}) {
    archive(before->step);
    before->x.resize(archive.size(before->x.size()));
    archive.bytes(before->x.data(), before->x.size() * sizeof(Eigen::Vector3d));
  }
  for (const auto& observer : observers_) observer->serialise(archive);
  plan_->serialise(archive);
  std::string state;
  if (!archive.loads()) state = simulation_.save();
  archive(state);
  if (archive.loads()) simulation_.load(state);
}

}  // namespace hysteron::experiments
