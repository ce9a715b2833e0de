// Time and memory of a step: a square of 0.5 m, hanging from two corners.  With --sizes: by the number of
// triangles; with --laws: of the laws alone, or in whole steps; with --hard: of steps that Newton's method
// finds hard; with --profile: of the kernels of a step; with --parts: of what a scene's model is made of;
// with --batch: of many cloths together.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/bench/batch.h"
#include "experiments/bench/element_costs.h"
#include "experiments/bench/hard_steps.h"
#include "experiments/bench/law_cost.h"
#include "experiments/bench/parts.h"
#include "experiments/bench/sizes.h"
#include "experiments/bench/table.h"
#include "experiments/bench/thread_scaling.h"
#include "experiments/workbench/app/decided_keys.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

struct BenchOptions {
  bool sizes = false;
  Numbers sizes_triangles = {1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6};
  std::string sizes_integrators = "explicit,semi-implicit,implicit,bdf2,tr-bdf2";
  bool laws = false;
  double elements = 1e6;
  Numbers laws_triangles = {};
  bool hard = false;
  std::string hard_scenes =
      "crumple-sphere,crumple-tube,crumple-fist,crumple-fall,crumple-press,fold,crease,drape";
  int hard_steps = 20, hard_triangles = 300;
  bool profile = false;
  Numbers profile_threads = {};
  bool parts = false;
  std::string parts_scenes = "crumple-fall,crumple-sphere,crease,drape,fold";
  int parts_triangles = 2000;
  double parts_after = 0.1;
  Numbers batch = {};
  int batch_threads = 1;
  double batch_after = 0.1;
  double budget = 120;
};
// clang-format off
const KeyRow<BenchOptions> kRows[] = {
    {"sizes", at<&BenchOptions::sizes>, "", any(), "", "time of a step by the number of triangles, beside that of moving its bytes: table.csv and plot_sizes"},
    {"sizes-triangles", at<&BenchOptions::sizes_triangles>, "", between(2, 1e7), "", "of --sizes"},
    {"sizes-integrators", at<&BenchOptions::sizes_integrators>, "", any(), "", "of --sizes, separated by commas"},
    {"laws", at<&BenchOptions::laws>, "", any(), "", "the laws alone: error on random histories, time and memory per element"},
    {"elements", at<&BenchOptions::elements>, "", between(1, 1e8), "", "of --laws"},
    {"laws-triangles", at<&BenchOptions::laws_triangles>, "", between(2, 1e7), "", "of --laws: not the laws alone, but whole semi-implicit and implicit steps of so many triangles"},
    {"hard", at<&BenchOptions::hard>, "", any(), "", "scenes to their end, as many at a time as --threads says (0: all cores); then their hardest steps again with other choices of the solver's, of which table.csv tells"},
    {"hard-scenes", at<&BenchOptions::hard_scenes>, "", any(), "", "of --hard: scenes of assets/scenes, TOML files, or the specimens fold, crease and drape, separated by commas; all: every shipped one"},
    {"hard-steps", at<&BenchOptions::hard_steps>, "", between(1, 1000), "", "of --hard: how many steps of each scene"},
    {"hard-triangles", at<&BenchOptions::hard_triangles>, "", between(1, 1e6), "", "of --hard"},
    {"profile", at<&BenchOptions::profile>, "", any(), "", "the kernels of the scene's steps: calls, time, bytes and the share of a copy's bandwidth, of which table.csv tells"},
    {"profile-threads", at<&BenchOptions::profile_threads>, "", between(1, 4096), "", "of --profile: numbers of the CPU's threads to compare, of those that the machine has"},
    {"parts", at<&BenchOptions::parts>, "", any(), "", "scenes as they are and without one part of their model each: memory, launches and time of a step, of which table.csv tells"},
    {"parts-scenes", at<&BenchOptions::parts_scenes>, "", any(), "", "of --parts: as --hard-scenes"},
    {"parts-triangles", at<&BenchOptions::parts_triangles>, "", between(1, 1e6), "", "of --parts"},
    {"parts-after", at<&BenchOptions::parts_after>, "s", at_least(0), "", "of --parts: simulated before steps are timed"},
    {"batch", at<&BenchOptions::batch>, "", between(1, 65535), "", "so many cloths of this scene together, of which table.csv tells, against one at a time"},
    {"batch-threads", at<&BenchOptions::batch_threads>, "", between(1, 1024), "", "of --batch: threads of the host that share the cloths"},
    {"batch-after", at<&BenchOptions::batch_after>, "s", at_least(0), "", "of --batch: simulated before steps are timed"},
    {"budget", at<&BenchOptions::budget>, "s", positive(), "", "of --sizes, --laws-triangles and --parts: wall clock for the table; rows that would not fit are left out and say so"},
};
// clang-format on

constexpr double kQuickElements = 10001;
constexpr int kQuickHardSteps = 3, kQuickHardTriangles = 200;
constexpr int kSteps = 40, kQuickSteps = 4;
constexpr int kSingleSteps = 9, kQuickSingleSteps = 3;  // that are timed by themselves

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene("cotton-broad-k50");
  scene.integrator = Integrator::semi_implicit;
  scene.step = 1e-3;
  scene.cloth.length = 0.5;
  scene.mesh = "aligned";
  scene.triangles = 4608;
  Pin corner;
  corner.select = "nearest";
  scene.pin.assign(2, corner);
  scene.pin[0].point = {0, 0.5, 0};
  scene.pin[1].point = {0.5, 0.5, 0};
  return setup;
}

// What was asked for, and how it is answered.
struct Request {
  const CommandLine& line;
  Setup setup;
  BenchOptions own;

  bool quick() const { return setup.options.quick; }
  bool json() const { return setup.options.json; }
  int steps() const { return quick() ? kQuickSteps : kSteps; }
  int single_steps() const { return quick() ? kQuickSingleSteps : kSingleSteps; }
  Json own_keys() { return to_json(bind(kRows, own)); }
};

int bench_elements(const Request& request) {
  const RowPrinter print({{"triangles", "triangles", 9},
                          {"precision", "precision", 9},
                          {"element", "element", 7},
                          {"law", "law", 8},
                          {"substeps", "substeps", 8},
                          {"solver_iterations", "iterations", 10, 1},
                          {"ms_per_step", "ms/step", 8, 3},
                          {"bytes_per_triangle", "bytes/triangle", 14},
                          {"device", "device", 0}},
                         request.json());
  const std::vector<Metrics> rows = element_costs(request.setup.scene, request.steps(), print);
  if (request.json()) print_json(rows);
  return 0;
}

int bench_by_size(Request& request, const SizeChoice& choice, bool compares_laws) {
  const RowPrinter print({{"triangles", "triangles", 9},
                          {"integrator", "integrator", 13},
                          {"law", "law", 8},
                          {"step_s", "step [s]", 9, 7},
                          {"ms_per_step", "ms/step", 9, 3},
                          {"newton_iterations_per_step", "newton", 6, 1},
                          {"solver_iterations_per_step", "linear", 6, 1},
                          {"floor_ms_per_step", "floor ms", 9, 4},
                          {"fraction_of_copy_bandwidth", "fraction", 8, 3},
                          {"skipped", "left out since it", 0}},
                         request.json());
  Run run(request.line, table_options(request.setup), to_json(request.setup.scene));
  run.note("bench", request.own_keys());
  SizeTable table = times_by_size(request.setup.scene, choice, print);
  if (compares_laws) compare_with_linear(table.rows);
  write_sizes(run, table, !request.setup.options.no_images);
  run.finish();
  if (request.json()) print_json(table.rows);
  return 0;
}

int bench_sizes(Request& request) {
  SizeChoice choice{
      request.own.sizes_triangles, {}, {request.setup.scene.law}, request.single_steps(), request.own.budget};
  for (const std::string& name : split(request.own.sizes_integrators))
    choice.integrators.push_back(value_named<Integrator>(name));
  return bench_by_size(request, choice, false);
}

// The stiffest law first, whose steps are then stable for the others, too.
int bench_laws_in_steps(Request& request) {
  const SizeChoice choice{request.own.laws_triangles,
                          {Integrator::semi_implicit, Integrator::implicit},
                          {"prandtl", "wong", "linear"},
                          request.single_steps(),
                          request.own.budget};
  return bench_by_size(request, choice, true);
}

int bench_laws(const Request& request) {
  Run run(request.line, table_options(request.setup), to_json(request.setup.scene));
  const std::vector<Metrics> rows =
      law_cost_table(request.setup.scene, static_cast<int>(request.own.elements));
  write_law_costs(run, rows, !request.setup.options.no_images);
  run.finish();
  if (request.json()) print_json(rows);
  const RowPrinter print({{"law", "law", 40},
                          {"element", "element", 7},
                          {"largest_error_percent_of_M0", "largest", 8, 2},
                          {"rms_error_percent_of_M0", "rms [% of M0]", 13, 2},
                          {"ns_per_element", "ns/element", 10, 3},
                          {"history_bytes_per_element", "bytes/element", 13}},
                         request.json());
  for (const Metrics& row : rows) print(row);
  return 0;
}

// How many steps are taken at a time.
int jobs_of(const Scene& scene) {
  if (scene.threads > 0) return scene.threads;
  return scene.device == DeviceChoice::cuda
             ? 1
             : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int bench_hard_steps(Request& request) {
  Run run(request.line, table_options(request.setup), request.own_keys());
  const BenchOptions& own = request.own;
  const std::vector<std::string> names = listed(own.hard_scenes, hard_scene_names());
  Scene like = request.setup.scene;
  const int jobs = jobs_of(like);
  like.threads = 1;  // of each job
  std::vector<HardStates> scenes(names.size());
  run.progress("looking for the hardest steps of " + own.hard_scenes);
  in_parallel(names.size(), jobs, [&](std::size_t i) {
    scenes[i] = find_hard_steps(hard_scene(names[i], own.hard_triangles, like), own.hard_steps);
  });
  for (const HardStates& scene : scenes)
    if (!scene.broken_off.empty()) run.warn(scene.of.name + ": " + scene.broken_off);
  const std::vector<Metrics> rows =
      hard_step_table(scenes, solver_variants(), jobs,
                      [&](const std::string& done) { run.progress("taken again: " + done); });
  finish_table(run, request.setup, rows);
  const RowPrinter print({{"newton_iterations", "newton", 6},
                          {"linear_iterations", "linear", 7},
                          {"mean_step_length", "length", 6, 2},
                          {"unbalanced", "unbalanced", 10},
                          {"halved", "halved", 6},
                          {"broken_off", "ended", 5},
                          {"ms_median", "ms/step", 7, 1},
                          {"variant", "variant", 0}},
                         request.json());
  for (const Metrics& row : rows)
    if (row["scene"].text() == "all") print(row);
  return 0;
}

void print(const StepProfile& profile) {
  const RowPrinter print({{"calls_per_step", "calls", 7, 1},
                          {"us_per_call", "us/call", 9, 1},
                          {"us_per_step", "us/step", 9, 1},
                          {"share_percent", "share %", 7, 1},
                          {"fraction_of_copy_bandwidth", "of copy", 7, 3},
                          {"kernel", "kernel", 0}},
                         false);
  for (const Metrics& row : profile.kernels) print(row);
  for (const auto& [key, value] : profile.step) fmt::print("{} {:.6g}\n", key, value.number());
}

// Numbers of threads to compare; none: as the scene has it.
std::vector<int> compared_threads(Request& request, Run& run) {
  const Numbers& asked = request.own.profile_threads;
  Scene& scene = request.setup.scene;
  if (asked.empty()) return {scene.threads};
  if (scene.device == DeviceChoice::cuda)
    throw Error::request("profile-threads compares threads of the CPU: device = cuda must be auto or cpu");
  scene.device = DeviceChoice::cpu;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const std::vector<int> threads = threads_within(asked, processors);
  if (threads.empty())
    throw Error::request(fmt::format("profile-threads: this machine has {} processors", processors));
  if (threads.size() < asked.size())
    run.warn(fmt::format("{} processors: larger numbers of threads are left out", processors));
  return threads;
}

void print_json(const std::vector<ThreadProfile>& profiles) {
  Json list = Json::array();
  for (const ThreadProfile& of : profiles) {
    Json entry = to_json(of.profile.step);
    entry["threads"] = of.threads;
    for (const Metrics& row : of.profile.kernels) entry["kernels"].push_back(to_json(row));
    list.push_back(std::move(entry));
  }
  std::cout << list.dump(2) << std::endl;
}

int bench_kernels(Request& request) {
  Run run(request.line, table_options(request.setup), to_json(request.setup.scene));
  const std::vector<int> threads = compared_threads(request, run);
  const Cloth cloth = make_cloth(request.setup.scene);
  std::vector<ThreadProfile> profiles;
  std::vector<Metrics> kernels;
  for (const int number : threads) {
    profiles.push_back(profile_with(number, request.setup.scene, cloth, request.steps()));
    const ThreadProfile& of = profiles.back();
    const std::string prefix = threads.size() > 1 ? fmt::format("{}_threads.", number) : "";
    for (const auto& [key, value] : of.profile.step) run.metric(prefix + key, value);
    for (Metrics row : of.profile.kernels) {
      row.set("threads", number);
      kernels.push_back(std::move(row));
    }
    if (request.json()) continue;
    if (threads.size() == 1)
      print(of.profile);
    else
      fmt::print("{:3} threads {:9.3f} ms/step\n", number, of.profile.step.number("ms_per_step"));
    std::fflush(stdout);
  }
  run.manifest().device = profiles.back().device;
  run.manifest().state_hash = profiles.back().state_hash;
  write_table(run, kernels);
  if (threads.size() > 1 && !request.setup.options.no_images) run.plot("plot_threads", thread_plot(profiles));
  run.finish();
  if (request.json()) print_json(profiles);
  return 0;
}

int bench_parts(Request& request) {
  const RowPrinter print({{"ms_per_step", "ms/step", 8, 2},
                          {"launches_per_step", "launches", 8},
                          {"newton_iterations_per_step", "newton", 6, 1},
                          {"solver_iterations_per_step", "linear", 7, 1},
                          {"bytes_per_triangle", "bytes/triangle", 14},
                          {"scene", "scene", 16},
                          {"without", "without", 20},
                          {"stopped", "stopped", 0}},
                         request.json());
  Run run(request.line, table_options(request.setup), request.own_keys());
  const BenchOptions& own = request.own;
  const PartsChoice choice{own.parts_after, request.single_steps()};
  const Budget budget(own.budget);
  std::vector<Metrics> rows;
  for (const std::string& name : listed(own.parts_scenes, hard_scene_names()))
    for (const Metrics& row :
         cost_of_parts(hard_scene(name, own.parts_triangles, request.setup.scene), choice, budget, print))
      rows.push_back(row);
  finish_table(run, request.setup, rows);
  return 0;
}

int bench_together(Request& request) {
  const RowPrinter print({{"cloths", "cloths", 6},
                          {"triangles", "triangles", 9},
                          {"ms_per_step", "ms/step", 9, 3},
                          {"cloth_steps_per_second", "steps/s", 9},
                          {"times_one_at_a_time", "times one", 9, 1},
                          {"solver_iterations_per_step", "linear", 6, 1},
                          {"setup_seconds", "setup [s]", 9, 2},
                          {"equal_states", "equal", 5}},
                         request.json());
  Run run(request.line, table_options(request.setup), to_json(request.setup.scene));
  run.note("bench", request.own_keys());
  const BenchOptions& own = request.own;
  const BatchChoice choice{own.batch, own.batch_threads, own.batch_after, request.single_steps()};
  finish_table(run, request.setup, times_together(request.setup.scene, choice, print));
  return 0;
}

// What each of its questions leaves of a scene.
std::vector<DecidedKey> left_out_by(const BenchOptions& own) {
  const std::set<std::string> machine = {"device", "precision", "threads"};
  if (own.hard) return unused_but("", machine, "--hard takes steps of other scenes");
  std::vector<DecidedKey> keys = {{"seconds", "steps are timed", true}};
  if (own.profile || !own.batch.empty()) return keys;
  if (own.parts) return unused_but("", machine, "--parts takes steps of other scenes");
  const auto decided = [&](const char* why, std::initializer_list<const char*> paths) {
    for (const char* path : paths) keys.push_back({path, why});
  };
  const bool in_steps = own.laws && !own.laws_triangles.empty();
  if (own.laws && !in_steps)
    decided("the laws are alone", {"law", "element", "integrator", "step", "triangles"});
  if (in_steps || own.sizes)
    decided("the table is of several", {"triangles", "integrator", "step", "substeps"});
  if (in_steps) decided("the table is of several", {"law"});
  if (!own.laws && !own.sizes) decided("the table is of several", {"law", "param", "element"});
  return keys;
}

int run_bench(const CommandLine& line) {
  BenchOptions own;
  const Setup setup = set_up(line, defaults(), bind(kRows, own), [&](Setup&) {
    own.sizes_triangles = {200, 800};
    own.elements = std::min(own.elements, kQuickElements);
    own.hard_steps = std::min(own.hard_steps, kQuickHardSteps);
    own.hard_triangles = std::min(own.hard_triangles, kQuickHardTriangles);
    own.parts_triangles = std::min(own.parts_triangles, kQuickHardTriangles);
  });
  if (setup.options.checkpoint > 0 || setup.options.resume)
    throw Error::request("--checkpoint and --resume: bench measures runs from their start");
  refuse_flags(line, left_out_by(own));
  Request request{line, setup, own};
  if (own.hard) return bench_hard_steps(request);
  if (!own.batch.empty()) return bench_together(request);
  if (own.profile) return bench_kernels(request);
  if (own.parts) return bench_parts(request);
  if (own.laws && !own.laws_triangles.empty()) return bench_laws_in_steps(request);
  if (own.laws) return bench_laws(request);
  if (own.sizes) return bench_sizes(request);
  return bench_elements(request);
}

}  // namespace

Experiment bench() {
  return {.name = "bench",
          .question = "time and memory of a step: a hanging square, three laws",
          .run = run_bench,
          .simulates = true,
          .own_keys = own_keys_of<kRows>,
          .defaults = defaults,
          .timed = true};
}

}  // namespace hysteron::experiments
