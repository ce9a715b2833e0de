#include "experiments/bench/hard_steps.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

// Sums over steps.
struct Effort {
  long steps = 0, newton = 0, linear = 0, unbalanced = 0, halved = 0, broken_off = 0;
  double step_lengths = 0, residual = 0;  // the largest residual
  std::vector<double> ms;

  void add(const Effort& other) {
    steps += other.steps;
    newton += other.newton;
    linear += other.linear;
    unbalanced += other.unbalanced;
    halved += other.halved;
    broken_off += other.broken_off;
    step_lengths += other.step_lengths;
    residual = std::max(residual, other.residual);
    ms.insert(ms.end(), other.ms.begin(), other.ms.end());
  }
};

// One step from a state.
Effort take(const HardScene& of, const SolverVariant& variant, const std::string& state) {
  Scene scene = of.scene;
  variant.choose(scene.tuning);
  const auto simulation = make_simulation(scene, of.cloth);
  simulation->load(state);
  simulation->wait();
  const SolverCounts before = simulation->solver_counts();
  const auto start = std::chrono::steady_clock::now();
  Effort effort;
  effort.steps = 1;
  try {
    simulation->advance(1);
    simulation->wait();
  } catch (const Error& error) {
    if (error.exit_code() == 1) throw;
    effort.broken_off = 1;
  }
  effort.ms = {1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
  const SolverCounts after = simulation->solver_counts();
  effort.newton = after.newton - before.newton;
  effort.linear = after.linear - before.linear;
  effort.unbalanced = after.unbalanced - before.unbalanced;
  effort.halved = after.retried - before.retried;
  effort.step_lengths = after.step_lengths - before.step_lengths;
  effort.residual = after.last_residual;
  return effort;
}

Metrics row_of(const std::string& variant, const std::string& scene, Effort effort) {
  std::sort(effort.ms.begin(), effort.ms.end());
  double sum = 0;
  for (double ms : effort.ms) sum += ms;
  const double steps = std::max(1.0, static_cast<double>(effort.newton));
  return {{"variant", variant},
          {"scene", scene},
          {"steps", effort.steps},
          {"newton_iterations", effort.newton},
          {"linear_iterations", effort.linear},
          {"mean_step_length", effort.step_lengths / steps},
          {"unbalanced", effort.unbalanced},
          {"halved", effort.halved},
          {"broken_off", effort.broken_off},
          {"ms_median", effort.ms.empty() ? NAN : effort.ms[effort.ms.size() / 2]},
          {"ms_sum", sum},
          {"largest_residual", effort.residual}};
}

}  // namespace

HardStates find_hard_steps(const HardScene& of, int steps) {
  HardStates found{of, {}, {}};
  const Scene& scene = of.scene;
  const auto simulation = make_simulation(scene, of.cloth);
  std::multimap<long, std::string> hardest;  // by Newton's iterations
  const long all = std::lround(scene.seconds / scene.step);
  try {
    for (long step = 0; step < all; ++step) {
      std::string state = simulation->save();
      const long before = simulation->solver_counts().newton;
      simulation->advance(1);
      hardest.emplace(simulation->solver_counts().newton - before, std::move(state));
      if (hardest.size() > static_cast<std::size_t>(steps)) hardest.erase(hardest.begin());
    }
  } catch (const Error& error) {
    if (error.exit_code() == 1) throw;
    found.broken_off = error.what();
  }
  for (auto hard = hardest.rbegin(); hard != hardest.rend(); ++hard)
    found.states.push_back(std::move(hard->second));
  return found;
}

std::vector<SolverVariant> solver_variants() {
  using T = SolverTuning;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return {{"in use", [](T&) {}},
          {"sliding friction with its second derivative", [](T& t) { t.sliding_far = t.sliding_near = 1; }},
          {"sliding friction by the quadratic above it, to the end", [](T& t) { t.sliding_near = 0; }},
          {"half of the difference near the minimum", [](T& t) { t.sliding_near = 0.5; }},
          {"limits of friction fixed after 3 iterations", [](T& t) { t.friction_rounds = 3; }},
          {"after 40", [](T& t) { t.friction_rounds = 40; }},
          {"linear solves to 1e-2 or better", [](T& t) { t.loosest_solve = 1e-2; }},
          {"linear solves to 1e-3 or better", [](T& t) { t.loosest_solve = 1e-3; }},
          {"corrections as far as twice the last", [](T& t) { t.longer = 2; }},
          {"corrections of any length", [=](T& t) { t.longer = kAny; }},
          {"positive stiffness to the end", [](T& t) { t.full_stiffness = 0; }},
          {"full stiffness from the start", [=](T& t) { t.full_stiffness = kAny; }}};
}

std::vector<Metrics> hard_step_table(const std::vector<HardStates>& scenes,
                                     const std::vector<SolverVariant>& variants, int jobs,
                                     const std::function<void(const std::string&)>& progress) {
  std::vector<Metrics> rows;
  for (const SolverVariant& variant : variants) {
    Effort all;
    for (const HardStates& scene : scenes) {
      std::vector<Effort> each(scene.states.size());
      in_parallel(each.size(), jobs,
                  [&](std::size_t i) { each[i] = take(scene.of, variant, scene.states[i]); });
      Effort effort;
      for (const Effort& one : each) effort.add(one);
      all.add(effort);
      rows.push_back(row_of(variant.name, scene.of.name, effort));
    }
    rows.push_back(row_of(variant.name, "all", all));
    progress(variant.name);
  }
  return rows;
}

}  // namespace hysteron::experiments
