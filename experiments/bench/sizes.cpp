#include "experiments/bench/sizes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/bench/step_profile.h"
#include "experiments/workbench/pages/gallery_exhibit.h"
#include "render/color_map.h"
#include "render/plot.h"
#include "sim/base/error.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr double kFall = 0.2, kImplicitStep = 1.0 / 60;  // [s]
constexpr int kWarmUp = 3, kProfiled = 2;                // numbers of steps
constexpr double kGrowth = 1.2;  // time of a row grows with triangles to this power, as iterations do

// The time [s] that a row of one kind took with fewer triangles, from which the next is extrapolated.
struct Experience {
  double triangles = 0, seconds = 0;

  double expected(double more) const {
    return triangles > 0 ? seconds * std::pow(more / triangles, kGrowth) : 0;
  }
};

void take(Integrator integrator, double explicit_step, Scene& scene) {
  scene.integrator = integrator;
  scene.step = scene.is_implicit() ? kImplicitStep : explicit_step;
  scene.substeps = 0;
}

Metrics blank_row(const Scene& scene, int triangles, const std::string& skipped) {
  Metrics row = {{"triangles", triangles},
                 {"integrator", enum_name(scene.integrator)},
                 {"law", scene.law},
                 {"precision", enum_name(scene.precision)},
                 {"step_s", NAN}};
  set(row, StepCost{});
  for (const char* key : {"bytes_per_step", "floor_ms_per_step", "fraction_of_copy_bandwidth",
                          "bytes_per_triangle", "setup_seconds"})
    row.set(key, NAN);
  row.set("state_hash", "");
  row.set("skipped", skipped);
  return row;
}

class TimesBySize {
 public:
  TimesBySize(const Scene& scene, const SizeParams& choice,
              const std::function<void(const Metrics&)>& measured)
      : scene_(scene), choice_(choice), measured_(measured) {
    std::sort(choice_.triangles.begin(), choice_.triangles.end());
  }

  SizeTable table() {
    for (const double triangles : choice_.triangles) {
      scene_.triangles = static_cast<int>(triangles);
      add_rows();
    }
    return std::move(table_);
  }

 private:
  void add_rows() {
    Cloth cloth;
    const std::string unfit = attempt(fall_, [&] { cloth = fallen(); });
    for (const Integrator integrator : choice_.integrators) {
      double& explicit_step = explicit_step_.emplace(integrator, scene_.step).first->second;
      Scene scene = scene_;
      take(integrator, explicit_step, scene);
      const int triangles = unfit.empty() ? cloth.mesh.faces() : scene.triangles;
      Metrics row = blank_row(scene, triangles, unfit);
      if (unfit.empty())
        row.set("skipped", attempt(row_[integrator], [&] { explicit_step = measure(scene, cloth, row); }));
      measured_(row);
      table_.rows.push_back(std::move(row));
    }
  }

  // Does the work unless the budget excludes it; returns why it was not done, or "".
  std::string attempt(Experience& experience, const std::function<void()>& work) {
    const std::string refusal = exclusion_reason(experience.expected(scene_.triangles));
    if (!refusal.empty()) return refusal;
    const Stopwatch clock;
    try {
      work();
    } catch (const Error& error) {
      if (error.exit_code() != 3) throw;  // the machine or the request failed, not the run
      return error.what();
    }
    experience = {static_cast<double>(scene_.triangles), clock.seconds()};
    return "";
  }

  // Returns why work of an `expected` time [s] is left out, or "" if it fits into the budget.
  std::string exclusion_reason(double expected) const {
    const double left = std::max(choice_.budget - clock_.seconds(), 0.0);
    if (expected < left) return "";
    if (left == 0) return fmt::format("the budget of {:.0f} s is used up", choice_.budget);
    return fmt::format("some {:.0f} s are needed, {:.0f} of {:.0f} s are left", expected, left,
                       choice_.budget);
  }

  Cloth fallen() const {
    Scene scene = scene_;
    take(Integrator::implicit, 0, scene);
    Cloth cloth = make_cloth(scene);
    const auto simulation = make_simulation(scene, cloth);
    simulation->advance(static_cast<int>(std::lround(kFall / scene.step)));
    cloth.start = simulation->positions();
    return cloth;
  }

  // Returns the length of a step [s].
  double measure(const Scene& scene, const Cloth& cloth, Metrics& row) {
    Stopwatch setup;
    auto simulation = make_simulation(scene, cloth);
    if (const StepLimits first = simulation->limits(); first.substeps > 1) {  // fine cloth needs thousands
      Scene stable = scene;
      stable.step = first.substep;
      setup = Stopwatch();
      simulation = make_simulation(stable, cloth);
    }
    row.set("setup_seconds", setup.seconds());
    simulation->advance(kWarmUp);
    const StepLimits limits = simulation->limits();
    const StepCost cost = cost_of_steps(*simulation, choice_.steps, 1, limits.substeps);
    row.set("step_s", limits.substep);
    set(row, cost);
    row.set("bytes_per_triangle", static_cast<double>(simulation->counts().bytes) / cloth.mesh.faces());
    row.set("state_hash", fmt::format("{:016x}", simulation->state_hash()));
    if (table_.copy_bandwidth == 0) {
      table_.copy_bandwidth = simulation->copy_bandwidth();
      table_.device = simulation->device();
    }
    const double bytes = stated_bytes(loops_of_steps(*simulation, kProfiled)) / kProfiled / limits.substeps;
    const double floor = 1e3 * bytes / table_.copy_bandwidth;
    row.set("bytes_per_step", bytes);
    row.set("floor_ms_per_step", floor);
    row.set("fraction_of_copy_bandwidth", floor / cost.ms);
    return limits.substep;
  }

  Scene scene_;  // its step is the longest explicit one
  SizeParams choice_;
  const std::function<void(const Metrics&)>& measured_;
  Stopwatch clock_;
  Experience fall_;
  std::map<Integrator, Experience> row_;
  std::map<Integrator, double> explicit_step_;  // the step that was stable with fewer triangles [s]
  SizeTable table_;
};

using render::Series;

// Returns the curve of the rows with the integrator of `like`, over the number of triangles.
Series size_curve(const std::vector<Metrics>& rows, const Metrics& like, const char* key, std::string label,
                  Series::Style style) {
  Series curve{std::move(label), {}, {}, style};
  for (const Metrics& row : rows) {
    if (row["integrator"] != like["integrator"]) continue;
    curve.add(row.number("triangles"), row.number(key));
  }
  return curve;
}

// Returns one row for each curve: those with the fewest triangles.
std::vector<const Metrics*> curves_in(const std::vector<Metrics>& rows) {
  std::vector<const Metrics*> first;
  for (const Metrics& row : rows)
    if (row.number("triangles") == rows.front().number("triangles")) first.push_back(&row);
  return first;
}

render::Plot size_plot(const SizeTable& table) {
  render::Plot plot{"Time of a step; dashed: its bytes at the bandwidth of a copy",
                    {"triangles", true},
                    {"time per step [ms]", true}};
  const std::vector<const Metrics*> curves = curves_in(table.rows);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const Metrics& like = *curves[k];
    Series measured = size_curve(table.rows, like, "ms_per_step", like["integrator"].text(),
                                 Series::Style::line_and_points);
    Series floor = size_curve(table.rows, like, "floor_ms_per_step", "", Series::Style::dashed);
    measured.color = floor.color = render::hex(render::method_color(k));
    plot.series.push_back(std::move(measured));
    plot.series.push_back(std::move(floor));
  }
  return plot;
}

FigureCaption size_caption(const SizeTable& table) {
  const Metrics& row = table.rows.front();
  return {
      "plot_sizes.png", "Time of a step by size",
      fmt::format("Median time of single steps of a square that hangs from two corners and has fallen for "
                  "0.2 s, in {} precision, on {}. Explicit and semi-implicit steps are as short as their "
                  "stability asks for, the others 1/60 s long (table.csv: step_s). Dashed: the bytes that "
                  "the loops of a step move at least, each array that a loop reads or writes counted once, "
                  "at the {:.0f} GB/s that a plain copy reaches here. Arrays that fit into a cache can be "
                  "moved faster.",
                  row["precision"].text(), table.device, 1e-9 * table.copy_bandwidth)};
}

}  // namespace

SizeTable times_by_size(const Scene& scene, const SizeParams& choice,
                        const std::function<void(const Metrics&)>& measured) {
  return TimesBySize(scene, choice, measured).table();
}

void write_sizes(Run& run, const SizeTable& table, bool pictures) {
  metrics_table(table.rows).write(run.path("table.csv"));
  if (table.device.empty()) return;
  run.manifest().device = table.device;
  run.metric("copy_bandwidth_GB_per_s", 1e-9 * table.copy_bandwidth);
  if (!pictures) return;
  run.plot("plot_sizes", size_plot(table));
  write_captions(run.path("README.md"), "Time of a step by size",
                 "What the figure of this folder shows; numbers in table.csv.", {size_caption(table)});
}

}  // namespace hysteron::experiments
