#include "experiments/bench/sizes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/bench/step_profile.h"
#include "sim/base/error.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr double kFall = 0.2, kImplicitStep = 1.0 / 60;  // [s]
constexpr int kWarmUp = 3, kProfiled = 2;                // steps
constexpr double kGrowth = 1.2;  // exponent of a row's time over triangles: iterations grow with them

// What rows of one kind have taken with fewer triangles.
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
                 {"integrator", name_of(scene.integrator)},
                 {"law", scene.law},
                 {"precision", name_of(scene.precision)},
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
  TimesBySize(const Scene& scene, const SizeChoice& choice,
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

  // Why it was not done; "" if it was.
  std::string attempt(Experience& experience, const std::function<void()>& work) {
    const std::string refusal = refusal_of(experience.expected(scene_.triangles));
    if (!refusal.empty()) return refusal;
    const Stopwatch clock;
    try {
      work();
    } catch (const Error& error) {
      if (error.exit_code() != 3) throw;  // not of the run, but of the machine or the request
      return error.what();
    }
    experience = {static_cast<double>(scene_.triangles), clock.seconds()};
    return "";
  }

  // Why what is expected to take so long [s] is left out; "" if it fits.
  std::string refusal_of(double expected) const {
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
    if (const StepLimits first = simulation->limits(); first.substeps > 1) {  // thousands for fine cloth
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

  Scene scene_;  // its step: the longest explicit one
  SizeChoice choice_;
  const std::function<void(const Metrics&)>& measured_;
  Stopwatch clock_;
  Experience fall_;
  std::map<Integrator, Experience> row_;
  std::map<Integrator, double> explicit_step_;  // that was stable with fewer triangles
  SizeTable table_;
};

}  // namespace

SizeTable times_by_size(const Scene& scene, const SizeChoice& choice,
                        const std::function<void(const Metrics&)>& measured) {
  return TimesBySize(scene, choice, measured).table();
}

}  // namespace hysteron::experiments
