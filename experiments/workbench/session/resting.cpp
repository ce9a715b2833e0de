#include "experiments/workbench/session/resting.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

constexpr int kMaxSteps = 20;
constexpr double kStill = 0.01;  // share of the thickness

Rest step_to_rest(Simulation& simulation, double still) {
  simulation.become_static();
  std::vector<Eigen::Vector3d> before = simulation.positions();
  Rest rest{INFINITY, ""};
  bool balanced = false;
  for (int step = 0; step < kMaxSteps && !(balanced && rest.moved <= still); ++step) {
    const long unbalanced = simulation.counts().unbalanced;
    simulation.advance(1);
    balanced = simulation.counts().unbalanced == unbalanced;
    std::vector<Eigen::Vector3d> x = simulation.positions();
    rest.moved = farthest_moved(x, before);
    before = std::move(x);
  }
  if (!balanced)
    rest.failure = fmt::format("{} steps without inertia found no equilibrium", kMaxSteps);
  else if (!(rest.moved <= still))
    rest.failure =
        fmt::format("the last of {} steps without inertia moved a vertex by {:.3g} m", kMaxSteps, rest.moved);
  return rest;
}

}  // namespace

double farthest_moved(const std::vector<Eigen::Vector3d>& now, const std::vector<Eigen::Vector3d>& before) {
  double largest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) largest = std::max(largest, (now[i] - before[i]).norm());
  return largest;
}

Rest seek_rest(Simulation& simulation, double thickness) {
  const std::string in_motion = simulation.save();
  Rest rest;
  try {
    rest = step_to_rest(simulation, kStill * thickness);
  } catch (const Error& error) {
    if (error.exit_code() != kCouldNotGoOn) throw;
    rest.failure = error.what();
  }
  if (!rest.failure.empty()) simulation.load(in_motion);
  return rest;
}

void wait_at_rest(Simulation& simulation, double seconds, double step) {
  constexpr double kGrowth = 0.2, kRounding = 1e-9;
  for (double passed = 0; seconds - passed > kRounding * seconds;) {
    const double length = std::min(std::max(step, kGrowth * passed), seconds - passed);
    simulation.advance_by(length);
    passed += length;
  }
}

// Searches for rest.  The result of a failed search is no state of the cloth, so the last one in motion stays
// the run's.
bool Session::find_rest() {
  const Rest rest = seek_rest(simulation_, setup_.scene.fabric.thickness);
  if (rest.failure.empty()) {
    if (plan_->wait > 0) wait_at_rest(simulation_, plan_->wait, setup_.scene.step);
    const std::vector<Eigen::Vector3d> x = simulation_.positions();
    const Snapshot instant{simulation_.time(), x, rest.moved / setup_.scene.step};
    if (plan_->each_step) plan_->each_step({instant.time, x, NAN});
    watch(instant);
    record(instant, "");
    return true;
  }
  run_.warn(fmt::format("no state of rest was found: {}; results are of the cloth in motion at t = {:.4g} s",
                        rest.failure, simulation_.time()));
  return false;
}

}  // namespace hysteron::experiments
