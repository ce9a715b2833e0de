// `hysteron stability` maps which simulations stay stable, and compares the explicit limit with the bound in
// use.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/stability/ripple.h"
#include "experiments/stability/stability.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/table_plot.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/parallel.h"
#include "sim/scene/choice.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr const char *kLimitSweep = "explicit-limit", *kRippleSweep = "ripple";
// Conditions of keys: sweeps that simulate cells, that have integrators, that have laws.
constexpr const char* kCellSweeps = "sweep = all | *-step | chapter-method | mesh | contact | scenes*";
constexpr const char* kIntegratorSweeps =
    "sweep = all | *-step | chapter-method | mesh | contact | scenes* | ripple";
constexpr const char* kLawSweeps = "sweep = all | *-step | mesh | contact | scenes* | ripple";

struct StabilityFlags {
  NamedDevice device = NamedDevice::cpu;
  std::string integrator = "all", law, sweep = "all";
  CellEffort effort;
  double threads = 0, limit_steps = 2000;
  Options options;
};

using F = StabilityFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"device", at<&F::device>, "", any(), "where cells are simulated; ripple and explicit-limit run on the cpu"},
    {"integrator", at<&F::integrator>, "", any(), "NAME, several separated by commas, or all"},
    {"law", at<&F::law>, "", any(), "NAME, several separated by commas, or all; default: linear, prandtl and wong in maps, all in scenes, prandtl and wong beside linear in ripple"},
    {"sweep", at<&F::sweep>, "", any(), "NAME, several separated by commas, or all"},
    {"seconds", at<&F::effort, &CellEffort::seconds>, "s", positive(), "simulated time of a cell"},
    {"work", at<&F::effort, &CellEffort::work>, "", positive(), "explicit substeps after which a cell's time is cut short; a step of implicit or bdf2 counts 20"},
    {"limit-steps", at<&F::limit_steps>, "", between(100, 1e7), "steps through which the energy must stay bounded (sweep explicit-limit)"},
    {"threads", at<&F::threads>, "", between(0, 1024), "of the host, a cell at a time each; 0: all cores, or 1 on cuda"},
};
// clang-format on
constexpr double kQuickWork = 300, kQuickLimitSteps = 600;

Keys option_keys(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

int thread_choice(const F& flags) {
  if (flags.threads > 0) return static_cast<int>(flags.threads);
  return flags.device == NamedDevice::cuda
             ? 1
             : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Returns the listed ones of the known names, each once, or all of them.
std::vector<std::string> chosen_names(const std::string& key, const std::string& list,
                                      const std::vector<std::string>& known) {
  std::vector<std::string> names = listed_names(key, list, known);
  for (const std::string& name : names) check_choice(key, name, known);
  return names;
}

SweepParams sweep_choice(const F& flags) {
  SweepParams choice;
  const auto integrators = names(Integrator{});
  if (flags.integrator != "all")
    choice.integrators =
        chosen_names("integrator", flags.integrator, {integrators.begin(), integrators.end()});
  if (!flags.law.empty()) choice.laws = chosen_names("law", flags.law, law_names());
  choice.device = device_choice(flags.device);
  choice.quick = flags.options.quick;
  return choice;
}

std::vector<SweepCell> tried(const F& flags, const std::vector<Sweep>& sweeps, Run& run) {
  std::vector<SweepCell> cells = untried_cells(sweeps, sweep_choice(flags));
  const auto stage = run.stage("cells");
  const std::size_t every = std::max<std::size_t>(1, cells.size() / 20);
  try_all(cells, flags.effort, thread_choice(flags), [&](std::size_t done) {
    if (done % every == 0)
      run.progress(std::to_string(done) + " of " + std::to_string(cells.size()) + " cells");
  });
  return cells;
}

// Returns cells.csv with a row for each cell; the unmeasured values of refused cells are empty.
Table cell_table(const std::vector<SweepCell>& cells) {
  Table table(
      "sweep,integrator,variant,x,y,law,element,precision,step [s],outcome,energy growth,"
      "ledger remainder,largest stretch,seconds asked [s],seconds simulated [s],steps,substeps per step,"
      "retried steps,wall [s],message");
  for (const SweepCell& cell : cells) {
    const Scene& scene = cell.attempt.scene;
    const Finding& f = cell.finding;
    const auto if_ran = [&](const Cell& field) { return f.outcome != Outcome::refused ? field : Cell(""); };
    table.row({cell.sweep,
               cell.integrator,
               cell.variant,
               cell.x,
               cell.y,
               scene.law,
               enum_name(scene.element),
               enum_name(scene.precision),
               scene.step,
               enum_name(f.outcome),
               if_ran(f.energy_growth),
               if_ran(f.remainder),
               if_ran(f.largest_stretch),
               f.requested_seconds,
               if_ran(f.seconds_simulated),
               if_ran(f.steps),
               if_ran(f.substeps),
               if_ran(f.retried_steps),
               f.wall_seconds,
               f.message});
  }
  return table;
}

// Counts the cells by outcome (ended, retried, refused, diverged), in all and for each integrator, with a
// table on stdout; diverged_default.
void count(Run& run, const Table& cells, bool print) {
  std::vector<std::vector<std::string>> lines = {{"integrator"}};
  const auto add = [&](const Table& rows, const std::string& prefix) {
    run.metric(prefix + "cells", rows.rows.size());
    for (const char* outcome : names(Outcome{})) {
      const std::size_t n = rows.where("outcome", outcome).rows.size();
      lines.back().push_back(lines.size() > 1 ? std::to_string(n) : outcome);
      run.metric(prefix + outcome, n);
    }
  };
  add(cells, "");
  for (const std::string& integrator : cells.values("integrator")) {
    lines.push_back({integrator});
    add(cells.where("integrator", integrator), integrator + ".");
  }
  const Table usual = cells.where("integrator", enum_name(default_scene().integrator));
  run.metric("diverged_default", usual.where("outcome", "diverged").rows.size());
  for (const auto& line : lines)
    if (print) fmt::print("{}\n", aligned(line, {-14, 9}));
}

// These colours differ for colour-blind eyes and in grey (Okabe & Ito 2008, lightened so that numbers can be
// read on them).
const std::vector<render::CellKind> kKinds = {{"ended", "#BFE3D5"},
                                              {"retried", "#F5E27A"},
                                              {"refused, with the reason", "#C9C9C9"},
                                              {"diverged", "#D55E00"}};

// Draws plot_SWEEP with a map for each integrator and variant.
void draw_maps(Run& run, const std::vector<Sweep>& sweeps, const Table& cells) {
  for (const Sweep& sweep : sweeps) {
    const Table part = cells.where("sweep", sweep.name);
    render::HeatMaps page{
        sweep.title, "Number: explicit substeps per step.", {sweep.x.label, {}}, {sweep.y.label, {}}, kKinds,
        {}};
    add_maps(page, part, {{"integrator", "variant"}, "x", "y"}, [&](const std::vector<std::size_t>& rows) {
      const auto outcome = value_named<Outcome>(part.word(rows[0], "outcome"));
      const bool several = part.number(rows[0], "substeps per step") > 1;
      return render::HeatMapCell{static_cast<int>(outcome),
                                 several ? part.word(rows[0], "substeps per step") : ""};
    });
    page.cell_width = page.x.ticks.size() > 10 ? 40 : 46;
    page.cell_height = page.y.ticks.size() > 10 ? 24 : 34;
    page.columns = static_cast<int>(page.maps.size() / sweep.variants.size());
    run.plot("plot_" + sweep.name, page, render::write_heat_maps);
  }
}

// Returns "explicit-limit: 2 of 20 cases stay bounded up to ..."; "" if every limit was found.
std::string beyond_search_warning(const std::vector<MeasuredLimit>& limits, double steps) {
  std::vector<std::string> beyond;
  for (const MeasuredLimit& limit : limits) {
    const LimitCase& of = limit.of;
    if (limit.is_beyond_search)
      beyond.push_back(fmt::format("{} {} {} {}", enum_name(of.mesh), enum_name(of.element),
                                   of.held ? "held" : "free", of.law));
  }
  if (beyond.empty()) return "";
  return fmt::format(
      "explicit-limit: {} of {} cases stay bounded up to {:g} times the bound, where the search ends: their "
      "limit is at least that ({}); limit-steps = {:g} may be too few for waves to grow",
      beyond.size(), limits.size(), kMaxRatio, join(beyond, ", "), steps);
}

// Writes limit.csv, limit_smallest_ratio and limit_largest_ratio.
void measure_limits(const F& flags, Run& run) {
  const std::vector<LimitCase> cases = limit_cases(flags.options.quick);
  std::vector<MeasuredLimit> limits(cases.size());
  in_parallel(cases.size(), thread_choice(flags), [&](std::size_t i) {
    limits[i] = measure_limit(cases[i], static_cast<int>(flags.limit_steps));
  });
  Table table(
      "mesh,element,edge,law,damping [s],largest amplitude [m],bound [s],measured [s],measured/bound");
  double least = kMaxRatio, most = 0, least_resonant = kMaxRatio;
  for (const MeasuredLimit& limit : limits) {
    const LimitCase& of = limit.of;
    table.row({enum_name(of.mesh), enum_name(of.element), of.held ? "held" : "free", of.law, of.damping,
               of.amplitude, limit.bound, limit.measured, limit.ratio()});
    if (of.resonates() && of.damping == 0) {
      least_resonant = std::min(least_resonant, limit.ratio());
      continue;
    }
    least = std::min(least, limit.ratio()), most = std::max(most, limit.ratio());
  }
  table.write(run.path("limit.csv"));
  const std::string beyond = beyond_search_warning(limits, flags.limit_steps);
  if (!beyond.empty()) run.warn(beyond);
  run.metric("limit_smallest_ratio", least);
  run.metric("limit_largest_ratio", most);
  if (least_resonant < kMaxRatio) run.metric("undamped_resonance_smallest_ratio", least_resonant);
}

// Draws plot_ripple-INTEGRATOR: relative amplitudes against time, for the largest first amplitude.
void draw_ripples(Run& run, const std::vector<Ripple>& ripples) {
  std::map<Integrator, render::Plot> plots;
  for (const Ripple& r : ripples) {
    if (r.of.amplitude != ripples.front().of.amplitude || r.times.size() < 2) continue;
    const std::string integrator = enum_name(r.of.integrator);
    render::Plot& plot = plots[r.of.integrator];
    plot.title = "Ripple at the highest frequency, " + integrator;
    plot.x = {"time [s]"};
    plot.y = {"amplitude over the first", true};
    plot.series.push_back(
        {fmt::format("{}, {:g} steps a period", r.of.law, r.of.steps_per_period), r.times, r.amplitudes});
  }
  for (const auto& [integrator, plot] : plots) run.plot("plot_ripple-" + enum_name(integrator), plot);
}

// Writes ripple.csv with a row for each case, ripple-amplitudes.csv with the drawn curves, and
// ripple_verdict, which states whether hysteresis damps ripples at short steps.
void measure_ripples(const F& flags, Run& run) {
  const SweepParams choice = sweep_choice(flags);
  std::vector<std::string> laws = choice.laws;
  if (laws.empty()) laws = {"prandtl", "wong"};
  const std::vector<RippleCase> cases = ripple_cases(choice.integrators, laws, choice.quick);
  std::vector<Ripple> ripples(cases.size());
  in_parallel(cases.size(), thread_choice(flags),
              [&](std::size_t i) { ripples[i] = measure_ripple(cases[i]); });
  Table table(
      "integrator,law,amplitude over k0,steps per period,step [s],decay per period [%],with half the step "
      "[%],"
      "closed form [%],failed");
  Table drawn("integrator,law,amplitude over k0,steps per period,time [s],amplitude over the first");
  for (const Ripple& r : ripples) {
    const std::string integrator = enum_name(r.of.integrator);
    table.row({integrator, r.of.law, r.of.amplitude, r.of.steps_per_period, r.step, 100 * r.decay,
               100 * r.control, std::isfinite(r.closed_form) ? Cell(100 * r.closed_form) : Cell(""),
               r.failed});
    for (std::size_t i = 0; i < r.times.size(); ++i)
      drawn.row({integrator, r.of.law, r.of.amplitude, r.of.steps_per_period, r.times[i], r.amplitudes[i]});
    if (r.of.amplitude == 1 && r.failed.empty())
      run.metric(
          fmt::format("ripple.{}.{}.{:g}_steps_decay_percent", integrator, r.of.law, r.of.steps_per_period),
          100 * r.decay);
  }
  table.write(run.path("ripple.csv"));
  drawn.write(run.path("ripple-amplitudes.csv"));
  if (const RippleVerdict verdict = ripple_verdict(ripples); std::isfinite(verdict.excess)) {
    run.metric("ripple_excess_least_percent", 100 * verdict.excess);
    run.metric("ripple_control_percent", 100 * verdict.control);
    run.metric("ripple_verdict", std::string(verdict.damps() ? "hysteresis damps" : "no difference shown"));
  }
  if (!flags.options.no_images) draw_ripples(run, ripples);
}

void check_limit_steps(double steps) {
  if (steps == std::floor(steps)) return;
  throw Error::invalid_input(fmt::format("limit-steps = {:g} must be a whole number", steps))
      .with_key("limit-steps", number_text(steps, 6));
}

// Returns the names of the requested sweeps; `all` stands alone.
std::vector<std::string> named_parts(const std::string& sweep) {
  std::vector<std::string> names = listed_names("sweep", sweep);
  if (names.size() > 1 && std::count(names.begin(), names.end(), "all") > 0)
    throw Error::invalid_input("sweep = " + sweep + ": all stands alone (--sweep)").with_key("sweep", sweep);
  return names;
}

int run_stability(const CommandLine& line) {
  F flags;
  set_keys(line, option_keys(flags), [&] {
    flags.effort.work = std::min(flags.effort.work, kQuickWork);
    flags.limit_steps = std::min(flags.limit_steps, kQuickLimitSteps);
  });
  check_limit_steps(flags.limit_steps);
  std::vector<std::string> names = named_parts(flags.sweep);
  const bool with_limit = std::erase(names, kLimitSweep) > 0 || flags.sweep == "all";
  const bool with_ripple = std::erase(names, kRippleSweep) > 0 || flags.sweep == "all";
  const std::vector<Sweep> sweeps = named_sweeps(names, sweep_choice(flags));

  Run run(line, flags.options, to_json(bind(kRows, flags)));
  if (!sweeps.empty()) run.reserve({"cells.csv"});
  if (with_limit) run.reserve({"limit.csv"});
  if (with_ripple) run.reserve({"ripple.csv", "ripple-amplitudes.csv"});
  if (!sweeps.empty()) {
    const Table cells = cell_table(tried(flags, sweeps, run));
    cells.write(run.path("cells.csv"));
    count(run, cells, !flags.options.json);
    if (!flags.options.no_images) draw_maps(run, sweeps, cells);
  }
  if (with_limit) measure_limits(flags, run);
  if (with_ripple) measure_ripples(flags, run);
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment stability() {
  return {.name = "stability",
          .question = "maps of what stays stable, over stiffness, step, mesh and extreme scenes",
          .run = run_stability,
          .own_keys = own_key_descriptions<option_keys>,
          .conditions = {
              {"limit-steps", "sweep = all | explicit-limit"},
              {"device | seconds | work", kCellSweeps, "a sweep of cells: any but explicit-limit and ripple"},
              {"integrator", kIntegratorSweeps, "any sweep but explicit-limit"},
              {"law", kLawSweeps, "any sweep but chapter-method and explicit-limit"}}};
}

}  // namespace hysteron::experiments
