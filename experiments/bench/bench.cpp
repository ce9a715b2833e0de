// `hysteron bench` measures time and memory of a step of a 0.5 m square that hangs from two corners.  --sizes
// varies the number of triangles; --profile times the kernels of a step.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/bench/sizes.h"
#include "experiments/bench/step_profile.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/cloth.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

struct BenchOptions {
  bool sizes = false;
  Numbers sizes_triangles = {1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6};
  std::string sizes_integrators = "explicit,semi-implicit,implicit,bdf2,tr-bdf2";
  bool profile = false;
  double budget = 120;
};
// clang-format off
const KeyRow<BenchOptions> kRows[] = {
    {"sizes", at<&BenchOptions::sizes>, "", any(), "time of a step by the number of triangles, beside that of moving its bytes: table.csv and plot_sizes"},
    {"sizes-triangles", at<&BenchOptions::sizes_triangles>, "", between(2, 1e7), "of --sizes"},
    {"sizes-integrators", at<&BenchOptions::sizes_integrators>, "", any(), "of --sizes, separated by commas"},
    {"profile", at<&BenchOptions::profile>, "", any(), "the kernels of the scene's steps: calls, time, bytes and the share of a copy's bandwidth, of which table.csv tells"},
    {"budget", at<&BenchOptions::budget>, "s", positive(), "of --sizes: wall clock for the table; rows that would not fit are left out and say so"},
};
// clang-format on

constexpr int kSteps = 40, kQuickSteps = 4;
constexpr int kSingleSteps = 9, kQuickSingleSteps = 3;  // number of steps that are timed one by one

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene("cotton-broad-k50");
  scene.integrator = Integrator::semi_implicit;
  scene.step = 1e-3;
  scene.cloth.length = 0.5;
  scene.mesh = "aligned";
  scene.triangles = 4608;
  Pin corner;
  corner.select = PinSelection::nearest;
  scene.pin.assign(2, corner);
  scene.pin[0].point = {0, 0.5, 0};
  scene.pin[1].point = {0.5, 0.5, 0};
  return setup;
}

// A request is what the user asked for, with the run that answers it.
struct Request {
  const CommandLine& line;
  Setup setup;
  BenchOptions own;

  int steps() const { return setup.options.quick ? kQuickSteps : kSteps; }
  int single_steps() const { return setup.options.quick ? kQuickSingleSteps : kSingleSteps; }
  bool json() const { return setup.options.json; }
  // Disables the manifest's JSON, because --json prints the table's rows here.
  Run run() const {
    Options options = setup.options;
    options.json = false;
    return {line, options, to_json(setup.scene)};
  }
};

// A number or a text of every row that is printed on stdout, right-aligned.
struct ShownColumn {
  const char *key, *head;
  int width, digits = 0;  // width in characters; decimals of numbers
};

// Returns a function that prints rows on stdout as they are measured and leaves unknown values blank; it
// prints nothing if JSON follows.
std::function<void(const Metrics&)> printer(const std::vector<ShownColumn>& columns, bool silent) {
  if (silent) return [](const Metrics&) {};
  std::vector<std::string> heads;
  std::vector<int> widths;
  for (const ShownColumn& column : columns) heads.emplace_back(column.head), widths.push_back(column.width);
  const auto print = [widths](const std::vector<std::string>& cells) {
    std::cout << aligned(cells, widths) << std::endl;
  };
  print(heads);
  return [columns, print](const Metrics& row) {
    std::vector<std::string> cells;
    for (const ShownColumn& column : columns) {
      const MetricValue& value = row[column.key];
      cells.push_back(value.is_text()     ? value.text()
                      : value.is_number() ? fmt::format("{:.{}f}", value.number(), column.digits)
                                          : "");
    }
    print(cells);
  };
}

void print_json(const std::vector<Metrics>& rows) {
  Json list = Json::array();
  for (const Metrics& row : rows) list.push_back(to_json(row));
  std::cout << list.dump(2) << std::endl;
}

struct Case {
  const char* element;
  const char* law;
  const char* memory = "stops";  // the key that holds prandtl's memory
};
constexpr Case kCases[] = {{"shape", "linear"}, {"shape", "prandtl"}, {"shape", "wong"},
                           {"hinge", "linear"}, {"hinge", "prandtl"}, {"hinge", "prandtl", "stack"},
                           {"hinge", "wong"}};
constexpr int kBatches = 7;

void take(const Case& c, Scene& scene) {
  scene.element = value_named<BendingElement>(c.element);
  scene.law = c.law;
  scene.param.clear();
  if (scene.law == "prandtl") scene.param["memory"] = c.memory;
}

int common_substeps(Scene scene, const Cloth& cloth) {
  int most = scene.substeps;
  for (const Case& c : kCases) {
    take(c, scene);
    scene.substeps = 0;
    most = std::max(most, make_simulation(scene, cloth)->limits().substeps);
  }
  return most;
}

Metrics measured_row(const Scene& scene, const Cloth& cloth, int steps) {
  const auto simulation = make_simulation(scene, cloth);
  const int triangles = cloth.mesh.faces();
  simulation->advance(steps);  // warms the caches and leaves the flat start
  const auto before = simulation->stage_seconds();
  const StepCost cost = cost_of_steps(*simulation, kBatches, steps);
  const auto after = simulation->stage_seconds();
  const std::string hash = fmt::format("{:016x}", simulation->state_hash());
  Metrics row = {{"scene", "hanging-square"},           {"triangles", triangles},
                 {"device", simulation->device()},      {"precision", enum_name(scene.precision)},
                 {"element", enum_name(scene.element)}, {"law", scene.law}};
  if (scene.law == "prandtl") row.set("memory", scene.param.at("memory"));
  row.set("integrator", enum_name(scene.integrator));
  row.set("substeps", simulation->limits().substeps);
  row.set("solver_iterations", cost.solver_iterations);
  row.set("ms_per_step", cost.ms);
  row.set("ms_per_step_fastest", cost.ms_fastest);
  for (std::size_t s = 0; s < after.size(); ++s)
    row.set("ms_" + after[s].first, 1e3 * (after[s].second - before[s].second) / (kBatches * steps));
  const double bytes = stated_bytes(loops_of_steps(*simulation, steps)) / steps;
  row.set("bytes_device", simulation->counts().bytes);
  row.set("bytes_per_triangle", static_cast<double>(simulation->counts().bytes) / triangles);
  row.set("bytes_per_step", bytes);
  row.set("fraction_of_copy_bandwidth", bytes / (1e-3 * cost.ms) / simulation->copy_bandwidth());
  row.set("state_hash", hash);
  return row;
}

// Measures a row for each element and law.  All of them take the substeps of the stiffest law, so that rows
// of one element differ by the law alone.
void bench_elements(const Request& request) {
  const auto print = printer({{"triangles", "triangles", 9},
                              {"precision", "precision", 9},
                              {"element", "element", 7},
                              {"law", "law", 8},
                              {"substeps", "substeps", 8},
                              {"solver_iterations", "iterations", 10, 1},
                              {"ms_per_step", "ms/step", 8, 3},
                              {"bytes_per_triangle", "bytes/triangle", 14},
                              {"device", "device", -1}},
                             request.json());
  Scene scene = request.setup.scene;
  const Cloth cloth = make_cloth(scene);
  scene.substeps = common_substeps(scene, cloth);
  std::vector<Metrics> rows;
  for (const Case& c : kCases) {
    take(c, scene);
    rows.push_back(measured_row(scene, cloth, request.steps()));
    print(rows.back());
  }
  if (request.json()) print_json(rows);
}

void bench_sizes(const Request& request) {
  const auto print = printer({{"triangles", "triangles", 9},
                              {"integrator", "integrator", 13},
                              {"step_s", "step [s]", 9, 7},
                              {"ms_per_step", "ms/step", 9, 3},
                              {"newton_iterations_per_step", "newton", 6, 1},
                              {"solver_iterations_per_step", "linear", 6, 1},
                              {"floor_ms_per_step", "floor ms", 9, 4},
                              {"fraction_of_copy_bandwidth", "fraction", 8, 3},
                              {"skipped", "left out since it", -1}},
                             request.json());
  SizeParams choice{request.own.sizes_triangles, {}, request.single_steps(), request.own.budget};
  for (const std::string& name : split(request.own.sizes_integrators))
    choice.integrators.push_back(value_named<Integrator>(name));
  Run run = request.run();
  BenchOptions own = request.own;
  run.note("bench", to_json(bind(kRows, own)));
  const SizeTable table = times_by_size(request.setup.scene, choice, print);
  write_sizes(run, table, !request.setup.options.no_images);
  run.finish();
  if (request.json()) print_json(table.rows);
}

void bench_kernels(const Request& request) {
  Run run = request.run();
  const auto simulation = make_simulation(request.setup.scene, make_cloth(request.setup.scene));
  const StepProfile profile = profile_of_steps(*simulation, request.steps());
  for (const auto& [key, value] : profile.step) run.metric(key, value);
  run.manifest().device = simulation->device();
  run.manifest().state_hash = fmt::format("{:016x}", simulation->state_hash());
  metrics_table(profile.kernels).write(run.path("table.csv"));
  run.finish();
  if (request.json()) {
    Json all = to_json(profile.step);
    for (const Metrics& row : profile.kernels) all["kernels"].push_back(to_json(row));
    std::cout << all.dump(2) << std::endl;
    return;
  }
  const auto print = printer({{"calls_per_step", "calls", 7, 1},
                              {"us_per_call", "us/call", 9, 1},
                              {"us_per_step", "us/step", 9, 1},
                              {"share_percent", "share %", 7, 1},
                              {"fraction_of_copy_bandwidth", "of copy", 7, 3},
                              {"kernel", "kernel", -1}},
                             false);
  for (const Metrics& row : profile.kernels) print(row);
  for (const auto& [key, value] : profile.step) fmt::print("{} {:.6g}\n", key, value.number());
}

// Returns the scene's keys that the request decides itself.
std::vector<FixedKey> left_out_by(const BenchOptions& own) {
  std::vector<FixedKey> keys = {{"seconds", "steps are timed", true}};
  const auto fixed_keys = [&](std::initializer_list<const char*> paths) {
    for (const char* path : paths) keys.push_back({path, "the table is of several"});
  };
  if (own.sizes) fixed_keys({"triangles", "integrator", "step", "substeps"});
  if (!own.sizes && !own.profile) fixed_keys({"law", "param", "element"});
  return keys;
}

int run_bench(const CommandLine& given) {
  BenchOptions own;
  CommandLine line = given;
  // The table lists several integrators, each of which reads keys of its own.
  if (last_text(line.flags, "sizes", "false") == "true") line.listed = {"integrator"};
  const Setup setup = set_up(line, defaults(), bind(kRows, own), [&](Setup&) {
    own.sizes_triangles = {200, 800};
  });
  if (setup.options.checkpoint > 0 || setup.options.resume)
    throw Error::invalid_input("--checkpoint and --resume: bench measures runs from their start");
  if (!setup.options.dump_scene.empty() || setup.options.explain)
    throw Error::invalid_input(
        "--dump-scene and --explain: bench only times steps; `hysteron run` of the same scene takes them")
        .with_key(setup.options.explain ? "explain" : "dump-scene", "");
  if (own.sizes && own.profile) throw Error::invalid_input("--sizes and --profile: bench does one at a time");
  throw_if_flags(line, left_out_by(own));
  const Request request{line, setup, own};
  if (own.profile)
    bench_kernels(request);
  else if (own.sizes)
    bench_sizes(request);
  else
    bench_elements(request);
  return 0;
}

}  // namespace

Experiment bench() {
  return {.name = "bench",
          .question = "time and memory of a step: a hanging square, three laws",
          .run = run_bench,
          .simulates = true,
          .own_keys = own_key_descriptions<kRows>,
          .defaults = defaults,
          .timed = true,
          .conditions = {{"sizes-triangles | sizes-integrators | budget", "sizes"}}};
}

}  // namespace hysteron::experiments
