// Time and memory of a step: a square of 0.5 m, hanging from two corners.  With --laws: of the laws alone;
// with --hard: of steps that Newton's method finds hard; with --profile: of the kernels of a step; with
// --parts: of what a scene's model is made of.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/bench/hard_steps.h"
#include "experiments/bench/law_cost.h"
#include "experiments/bench/parts.h"
#include "experiments/bench/step_profile.h"
#include "experiments/bench/table.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"
#include "sim/base/comma_list.h"
#include "sim/base/parallel.h"
#include "sim/scene/cloth.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

struct Case {
  const char* element;
  const char* law;
  const char* memory = "stops";  // of prandtl
};
constexpr Case kCases[] = {{"shape", "linear"}, {"shape", "prandtl"}, {"shape", "wong"},
                           {"hinge", "linear"}, {"hinge", "prandtl"}, {"hinge", "prandtl", "stack"},
                           {"hinge", "wong"}};

struct BenchOptions {
  bool laws = false;
  double elements = 1e6;
  bool hard = false;
  std::string hard_scenes =
      "crumple-sphere,crumple-tube,crumple-fist,crumple-fall,crumple-press,fold,crease,drape";
  int hard_steps = 20, hard_triangles = 300;
  bool profile = false;
  bool parts = false;
  std::string parts_scenes = "crumple-fall,crumple-sphere,crease,drape,fold";
  int parts_triangles = 2000;
  double parts_after = 0.1;
};
// clang-format off
const KeyRow<BenchOptions> kRows[] = {
    {"laws", at<&BenchOptions::laws>, "", any(), "", "the laws alone: error on random histories, time and memory per element"},
    {"elements", at<&BenchOptions::elements>, "", between(1, 1e8), "", "of --laws"},
    {"hard", at<&BenchOptions::hard>, "", any(), "", "scenes to their end, as many at a time as --threads says (0: all cores); then their hardest steps again with other choices of the solver's, of which table.csv tells"},
    {"hard-scenes", at<&BenchOptions::hard_scenes>, "", any(), "", "of --hard: scenes of assets/scenes, TOML files, or the specimens fold, crease and drape, separated by commas"},
    {"hard-steps", at<&BenchOptions::hard_steps>, "", between(1, 1000), "", "of --hard: how many steps of each scene"},
    {"hard-triangles", at<&BenchOptions::hard_triangles>, "", between(1, 1e6), "", "of --hard"},
    {"profile", at<&BenchOptions::profile>, "", any(), "", "the kernels of the scene's steps: calls, time, bytes and the share of a copy's bandwidth, of which table.csv tells"},
    {"parts", at<&BenchOptions::parts>, "", any(), "", "scenes as they are and without one part of their model each: memory, launches and time of a step, of which table.csv tells"},
    {"parts-scenes", at<&BenchOptions::parts_scenes>, "", any(), "", "of --parts: as --hard-scenes"},
    {"parts-triangles", at<&BenchOptions::parts_triangles>, "", between(1, 1e6), "", "of --parts"},
    {"parts-after", at<&BenchOptions::parts_after>, "s", at_least(0), "", "of --parts: simulated before steps are timed"},
};
// clang-format on

void take(const Case& c, Scene& scene) {
  scene.element = value_named<BendingElement>(c.element);
  scene.law = c.law;
  scene.param.clear();
  if (scene.law == "prandtl") scene.param["memory"] = c.memory;
}
constexpr double kQuickElements = 10001;
constexpr int kQuickHardSteps = 3, kQuickHardTriangles = 200;
constexpr int kSteps = 40, kQuickSteps = 4;
constexpr int kBatches = 7;  // the median of their times is reported

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
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

// Bytes that the stages of a step must move, each array that a loop reads or writes counted once per pass:
// angles, law and forces per substep, the membrane per Newton step, matrix and vectors per iteration of the
// solve.
double bytes_per_step(const Simulation& simulation) {
  double bending = 0, history = 0, membrane = 0, solve = 0, state = 0;
  for (const ScenePart& part : simulation.parts()) {
    const double bytes = static_cast<double>(part.bytes);
    if (part.name == "bending") bending = bytes;
    if (part.name == "bending history") history = bytes;
    if (part.name == "membrane") membrane = bytes;
    if (part.name == "implicit solve") solve = bytes;
    if (part.name == "state") state = bytes;
  }
  return simulation.limits().substeps * (bending + 2 * history + state) + 2 * membrane +
         simulation.solver_iterations() * solve;
}

// One row of the table.
Metrics measure(Simulation& simulation, const Scene& scene, int triangles, int steps) {
  simulation.advance(steps);  // warm caches, and away from the flat start
  std::vector<double> ms;
  const auto before = simulation.stage_seconds();
  for (int batch = 0; batch < kBatches; ++batch) {
    const auto start = std::chrono::steady_clock::now();
    simulation.advance(steps);
    simulation.wait();
    ms.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
                 steps);
  }
  std::sort(ms.begin(), ms.end());
  const double median = ms[kBatches / 2];
  Metrics row;
  row.set("scene", "hanging-square");
  row.set("triangles", triangles);
  row.set("device", simulation.device());
  row.set("precision", name_of(scene.precision));
  row.set("element", name_of(scene.element));
  row.set("law", scene.law);
  if (scene.law == "prandtl") row.set("memory", scene.param.at("memory"));
  row.set("integrator", name_of(scene.integrator));
  row.set("substeps", simulation.limits().substeps);
  row.set("solver_iterations", simulation.solver_iterations());
  row.set("ms_per_step", median);
  row.set("ms_per_step_fastest", ms.front());
  const auto after = simulation.stage_seconds();
  for (std::size_t s = 0; s < after.size(); ++s)
    row.set("ms_" + after[s].first, 1e3 * (after[s].second - before[s].second) / (kBatches * steps));
  const double bytes = bytes_per_step(simulation);
  row.set("bytes_device", simulation.device_bytes());
  row.set("bytes_per_triangle", static_cast<double>(simulation.device_bytes()) / triangles);
  row.set("bytes_per_step", bytes);
  row.set("fraction_of_copy_bandwidth", bytes / (1e-3 * median) / simulation.copy_bandwidth());
  row.set("state_hash", fmt::format("{:016x}", simulation.state_hash()));
  return row;
}

void print(const Metrics& row) {
  fmt::print("{:8.0f} {:<7} {:<6} {:<8} {:3.0f} {:7.1f} {:10.3f} {:9.1f}   {}\n", row["triangles"].number(),
             row["precision"].text(), row["element"].text(), row["law"].text(), row["substeps"].number(),
             row["solver_iterations"].number(), row["ms_per_step"].number(),
             row["bytes_per_triangle"].number(), row["device"].text());
  std::fflush(stdout);
}

void print_json(const std::vector<Metrics>& rows) {
  Json list = Json::array();
  for (const Metrics& row : rows) list.push_back(to_json(row));
  std::cout << list.dump(2) << std::endl;
}

// All laws of an element take the substeps of the stiffest, so that the rows differ by the law alone.
int common_substeps(Scene scene, const Cloth& cloth) {
  int most = scene.substeps;
  for (const Case& c : kCases) {
    take(c, scene);
    scene.substeps = 0;
    most = std::max(most, make_simulation(scene, cloth)->limits().substeps);
  }
  return most;
}

int bench_laws(const CommandLine& line, const Setup& setup, int elements) {
  Options options = setup.options;
  options.json = false;  // of its rows, not of the manifest
  Run run(line, options, to_json(setup.scene));
  const std::vector<Metrics> rows = law_cost_table(setup.scene, elements);
  write_law_costs(run, rows, !options.no_images);
  run.finish();
  if (setup.options.json) {
    print_json(rows);
    return 0;
  }
  fmt::print("{:<18} element  largest  rms [% of M0]  ns/element  bytes/element\n", "law");
  for (const Metrics& row : rows) {
    fmt::print("{:<18} {:<7} {:8.2f} {:8.2f} {:12.3f} {:10.0f}\n", row["law"].text(), row["element"].text(),
               row["largest_error_percent_of_M0"].number(), row["rms_error_percent_of_M0"].number(),
               row["ns_per_element"].number(), row["history_bytes_per_element"].number());
  }
  return 0;
}

// How many steps are taken at a time.
int jobs_of(const Scene& scene) {
  if (scene.threads > 0) return scene.threads;
  return scene.device == DeviceChoice::cuda
             ? 1
             : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int bench_hard_steps(const CommandLine& line, const Setup& setup, BenchOptions own) {
  Options options = setup.options;
  options.json = false;  // of its rows, not of the manifest
  Run run(line, options, to_json(bind(kRows, own)));
  const std::vector<std::string> names = split(own.hard_scenes);
  Scene like = setup.scene;
  const int jobs = jobs_of(like);
  like.threads = 1;  // of each job
  std::vector<HardStates> scenes(names.size());
  run.progress("looking for the hardest steps of " + own.hard_scenes);
  in_parallel(names.size(), jobs, [&](std::size_t i) {
    scenes[i] = find_hard_steps(hard_scene(names[i], own.hard_triangles, like), own.hard_steps);
  });
  for (const HardStates& scene : scenes)
    if (!scene.broken_off.empty()) run.progress("warning: " + scene.of.name + ": " + scene.broken_off);
  const std::vector<Metrics> rows =
      hard_step_table(scenes, solver_variants(), jobs,
                      [&](const std::string& done) { run.progress("taken again: " + done); });
  write_table(run, rows);
  run.finish();
  if (setup.options.json) {
    print_json(rows);
    return 0;
  }
  fmt::print("newton  linear length unbalanced halved ended residual ms/step variant\n");
  for (const Metrics& row : rows)
    if (row["scene"].text() == "all")
      fmt::print("{:6.0f} {:7.0f} {:6.2f} {:10.0f} {:6.0f} {:5.0f} {:8.1e} {:7.1f} {}\n",
                 row.number("newton_iterations"), row.number("linear_iterations"),
                 row.number("mean_step_length"), row.number("unbalanced"), row.number("halved"),
                 row.number("broken_off"), row.number("largest_residual"), row.number("ms_median"),
                 row["variant"].text());
  return 0;
}

void print(const StepProfile& profile) {
  fmt::print("  calls   us/call   us/step  share  of copy  kernel\n");
  for (const Metrics& row : profile.kernels) {
    const double share = row.number("fraction_of_copy_bandwidth");
    fmt::print("{:7.1f} {:9.1f} {:9.1f} {:5.1f}% {:>8}  {}\n", row.number("calls_per_step"),
               row.number("us_per_call"), row.number("us_per_step"), row.number("share_percent"),
               std::isfinite(share) ? fmt::format("{:.1f}%", 100 * share) : "", row["kernel"].text());
  }
  for (const auto& [key, value] : profile.step) fmt::print("{} {:.6g}\n", key, value.number());
}

int bench_kernels(const CommandLine& line, const Setup& setup) {
  Options options = setup.options;
  options.json = false;  // of the profile, not of the manifest
  Run run(line, options, to_json(setup.scene));
  const auto simulation = make_simulation(setup.scene, make_cloth(setup.scene));
  const StepProfile profile = profile_of_steps(*simulation, options.quick ? kQuickSteps : kSteps);
  run.manifest().device = simulation->device();
  run.manifest().state_hash = fmt::format("{:016x}", simulation->state_hash());
  for (const auto& [key, value] : profile.step) run.metric(key, value);
  write_table(run, profile.kernels);
  run.finish();
  if (!setup.options.json) {
    print(profile);
    return 0;
  }
  Json entry = to_json(profile.step);
  for (const Metrics& row : profile.kernels) entry["kernels"].push_back(to_json(row));
  std::cout << Json::array({entry}).dump(2) << std::endl;
  return 0;
}

int bench_parts(const CommandLine& line, const Setup& setup, BenchOptions own) {
  Options options = setup.options;
  options.json = false;  // of its rows, not of the manifest
  Run run(line, options, to_json(bind(kRows, own)));
  std::vector<Metrics> rows;
  if (!setup.options.json) fmt::print("ms/step launches newton  linear bytes/triangle scene without\n");
  for (const std::string& name : split(own.parts_scenes))
    for (const Metrics& row : cost_of_parts(hard_scene(name, own.parts_triangles, setup.scene),
                                            own.parts_after, options.quick ? kQuickSteps : kSteps)) {
      rows.push_back(row);
      if (setup.options.json) continue;
      fmt::print("{:7.2f} {:8.0f} {:6.1f} {:7.1f} {:14.0f} {} {}\n", row.number("ms_per_step"),
                 row.number("launches_per_step"), row.number("newton_iterations_per_step"),
                 row.number("solver_iterations_per_step"), row.number("bytes_per_triangle"), name,
                 row["stopped"].text().empty() ? row["without"].text() : row["stopped"].text());
      std::fflush(stdout);
    }
  write_table(run, rows);
  run.finish();
  if (setup.options.json) print_json(rows);
  return 0;
}

int run_bench(const CommandLine& line) {
  BenchOptions own;
  const Setup setup = set_up(line, defaults(), bind(kRows, own), [&](Setup&) {
    own.elements = std::min(own.elements, kQuickElements);
    own.hard_steps = std::min(own.hard_steps, kQuickHardSteps);
    own.hard_triangles = std::min(own.hard_triangles, kQuickHardTriangles);
    own.parts_triangles = std::min(own.parts_triangles, kQuickHardTriangles);
  });
  if (setup.options.checkpoint > 0 || setup.options.resume)
    throw Error::request("--checkpoint and --resume: bench measures runs from their start");
  if (own.hard) return bench_hard_steps(line, setup, own);
  if (own.profile) return bench_kernels(line, setup);
  if (own.parts) return bench_parts(line, setup, own);
  if (own.laws) return bench_laws(line, setup, static_cast<int>(own.elements));
  std::vector<Metrics> rows;
  const Cloth cloth = make_cloth(setup.scene);
  Scene scene = setup.scene;
  scene.substeps = common_substeps(setup.scene, cloth);
  if (!setup.options.json)
    fmt::print("triangles precision element law substeps iterations ms/step bytes/triangle device\n");
  for (const Case& c : kCases) {
    take(c, scene);
    const auto simulation = make_simulation(scene, cloth);
    rows.push_back(
        measure(*simulation, scene, cloth.mesh.faces(), setup.options.quick ? kQuickSteps : kSteps));
    if (!setup.options.json) print(rows.back());
  }
  if (setup.options.json) print_json(rows);
  return 0;
}

}  // namespace

Experiment bench() {
  return {.name = "bench",
          .question = "time and memory of a step: a hanging square, three laws",
          .run = run_bench,
          .simulates = true,
          .own_keys = own_keys_of<kRows>,
          .defaults = defaults};
}

}  // namespace hysteron::experiments
