// `hysteron fab` simulates the loop test of a FAB tester as an elastica: a strip between clamps is buckled or
// stretched in growing cycles, along the clamps' recorded path if data are given, or to given compressions.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "experiments/fab/loops.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/identification/fab_fabric.h"
#include "sim/reference/fab_loops.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {
namespace {

// The direction along which a strip is cut, by the letter of the tester's records: length (warp), width
// (weft), bias.
enum class CutAlong { L, W, B };
constexpr std::array<const char*, 3> names(CutAlong) { return {"L", "W", "B"}; }

struct TestFlags {
  std::string fabric = Fabric{}.name;
  std::string data, test = "D1";
  TesterUnits units = TesterUnits::si;
  CutAlong direction = CutAlong::L;
  double gauge = 0.021, slack = 0.0015, width = 0.04;
  std::string compressions = "0.0038,0.0063,0.0088";
  int steps = 60;
  Options options;
};

using F = TestFlags;
// clang-format off
const KeyRow<TestFlags> kRows[] = {
    {"fabric.name", at<&F::fabric>, "", any(), "NAME or FILE, as `fit --fab` writes it or any other", {.flag = "fabric"}},
    {"fab.data", at<&F::data>, "", any(), "measured loops, whose way the clamps go; CSV with direction, test, branch, clamp_distance_m, force_N, gauge_length_m, width_m"},
    {"units", at<&F::units>, "", any(), "of the data: m and N, or the tester's cm and gf (columns _cm, _gf)"},
    {"fab.direction", at<&F::direction>, "", any(), "along which the strip is cut: length (warp), width (weft), bias"},
    {"fab.test", at<&F::test>, "", any(), "U1 bends up, D1 down, S1 stretches; another number is another gauge"},
    {"fab.gauge", at<&F::gauge>, "m", between(1e-3, 1), "without data: length of the strip between the clamps"},
    {"fab.slack", at<&F::slack>, "m", positive(), "without data: by which the clamps are closer at first, in bending"},
    {"fab.compressions", at<&F::compressions>, "", any(), "without data: of the cycles, from the gauge on, separated by commas [m]"},
    {"fab.width", at<&F::width>, "m", between(1e-3, 1), "without data: of the strip"},
    {"fab.steps", at<&F::steps>, "", between(4, 1e5), "without data: rows of a branch, as they are written; areas and peaks are those of 60 rows or more"},
};
// clang-format on
constexpr int kQuickSteps = 20;
constexpr int kFineSteps = 60;  // rows of a branch, at which chords cut 0.2 % off a loop's area

Keys option_keys(TestFlags& flags) { return with_output_options(bind(kRows, flags), flags.options); }

std::vector<double> parsed_numbers(const std::string& text, const std::string& key) {
  std::vector<double> numbers;
  for (const std::string& word : split(text)) {
    const auto number = number_in(word);
    if (!number)
      throw Error::invalid_input(key + " = " + text + " must be numbers [m] separated by commas")
          .with_key(key, text);
    numbers.push_back(*number);
  }
  return numbers;
}

FabLoops loops_without_data(const TestFlags& flags, int steps) {
  const std::vector<double> amplitudes = parsed_numbers(flags.compressions, "fab.compressions");
  const bool bends = flags.test.empty() || flags.test.front() != 'S';
  for (const double amplitude : amplitudes)
    if (!(amplitude > (bends ? flags.slack : 0) && (!bends || amplitude < 0.8 * flags.gauge)))
      throw Error::invalid_input(
          fmt::format("a compression of {:g} m must be > fab.slack = {:g} m and < 0.8 of "
                      "fab.gauge = {:g} m",
                      amplitude, flags.slack, flags.gauge))
          .with_key("fab.compressions", flags.compressions);
  FabLoops loops = made_up_loops(flags.test, flags.gauge, flags.slack, amplitudes, steps);
  loops.direction = enum_name(flags.direction);
  loops.width = flags.width;
  check_clamp_path(loops, "loops to be simulated", "fab");  // as for fab.csv when it is read
  return loops;
}

void check_test(const std::string& test) {
  if (test.empty() || std::string("UDS").find(test.front()) == std::string::npos)
    throw Error::invalid_input("fab.test = " + test +
                               " must be U.. (bends up) | D.. (down) | S.. (stretches)")
        .with_key("fab.test", test);
}

void print_cycles(const ComparedLoops& compared) {
  const BranchForces measured = compared.measured_forces();
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle) {
    const double area = loop_area(compared.loops, compared.run.force, cycle);
    fmt::print("cycle {}: area {:.3g} mJ/m, force range {:.3g} N/m", cycle + 1, 1e3 * area,
               force_range(compared.run.force, cycle));
    if (compared.measured) {
      const double seen = loop_area(compared.loops, measured, cycle);
      fmt::print("; measured {:.3g} mJ/m ({:+.0f} %), {:.3g} N/m", 1e3 * seen, 100 * (area / seen - 1),
                 force_range(measured, cycle));
    }
    fmt::print("\n");
  }
}

// Computes more rows than are written, so that areas are summed over the branch and not over its chords; the
// forces are the same.
ComparedLoops read_between_rows(const TestFlags& flags, const FabStrip& strip) {
  const int parts = (kFineSteps + flags.steps - 1) / flags.steps;
  const FabLoops loops = loops_without_data(flags, parts * flags.steps);
  return {loops, run_fab(loops, strip), false};
}

// Warns that the strip is an elastica of springs and stops, which has neither time nor a rest curvature of
// its own.
std::string unsimulated_warning(const Fabric& fabric) {
  std::vector<std::string> parts;
  if (fabric.bending.set.on()) parts.push_back("[bending.set]");
  if (!fabric.bending.branches.empty()) parts.push_back("[bending.branches]");
  if (parts.empty()) return "";
  return fmt::format(
      "fabric {}: fab does not simulate its {}: the strip is an elastica with elasticity and friction alone",
      fabric.name, join(parts, " and "));
}

std::string mean_of_faces_warning(const Fabric& fabric) {
  const Faces& faces = fabric.bending.faces;
  if (!faces.on()) return "";
  return fmt::format(
      "fabric {}: fab simulates its back-bending = {:g} and back-friction = {:g} as the means of both sides, "
      "up "
      "and down alike: the middle of the strip bends to one side, what is next to the clamps to the other",
      fabric.name, faces.bending, faces.friction);
}

int run_test(const CommandLine& line) {
  TestFlags flags;
  const Keys keys = option_keys(flags);
  set_keys(line, keys, [&] { flags.steps = std::min(flags.steps, kQuickSteps); });
  flags.fabric = last_text(line.flags, "fabric", flags.fabric);
  check_test(flags.test);
  const std::vector<std::string> warnings = checked_fabric_warnings(flags.fabric);
  const Fabric fabric = read_fabric(flags.fabric, "--fabric").fabric;
  const FabStrip strip = fab_fabric(fabric).strip(enum_name(flags.direction));
  const bool measured = !flags.data.empty(), bends = flags.test.front() != 'S';
  const auto asks_for = [&](const FabLoops& one) {
    return one.direction == enum_name(flags.direction) && one.test == flags.test;
  };
  const FabLoops loops = measured ? find_loops(read_fab(flags.data, flags.units, "fab", {asks_for}),
                                               enum_name(flags.direction), flags.test)
                                  : loops_without_data(flags, flags.steps);
  Run run(line, flags.options, to_json(keys));
  for (const auto* texts : {&warnings, &loops.warnings})
    for (const std::string& text : *texts) run.warn(text);
  for (const std::string& text : {unsimulated_warning(fabric), bends ? mean_of_faces_warning(fabric) : ""})
    if (!text.empty()) run.warn(text);
  run.reserve({"fab.csv"});
  const ComparedLoops rows(loops, run_fab(loops, strip), measured);
  const bool is_coarse = !measured && flags.steps < kFineSteps;
  const ComparedLoops compared = is_coarse ? read_between_rows(flags, strip) : rows;
  const std::string title = fabric.name + ", " + loops.name();
  add_metrics(run, compared);
  write_loops(run, "fab.csv", rows);
  if (!flags.options.no_images) {
    draw_loops(run, "plot_fab", "FAB loops of " + title, compared);
    draw_shapes(run, "plot_shapes", "Strip between clamps, " + title, compared);
  }
  finish_with_report(run);
  if (!flags.options.json) print_cycles(compared);
  return 0;
}

}  // namespace

Experiment fab() {
  return {.name = "fab",
          .question = "virtual FAB loop test: a strip buckled or stretched between clamps, in growing cycles",
          .run = run_test,
          .own_keys = own_key_descriptions<option_keys>,
          .conditions = {{"fab.gauge | fab.slack | fab.compressions | fab.width | fab.steps", "not fab.data"},
                         {"fab.slack", "fab.test != S*", "a test that bends"},
                         {"units", "fab.data"}}};
}

}  // namespace hysteron::experiments
