#include "sim/time/implicit_integrator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/time/step_errors.h"
#include "sim/time/time_integrator.h"

namespace hysteron {

template <class Real, class Device>
ImplicitIntegrator<Real, Device>::ImplicitIntegrator(Body<Real, Device>& body, const StepLimits& limits)
    : TimeIntegrator<Real, Device>(body),
      solver_(body),
      substeps_(limits.substeps),
      tolerance_(body.scene.tolerance) {}

template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::step(double start, double h) {
  const bool finds_equilibria = body_.scene.integrator == Integrator::quasi_static || solver_.is_static();
  if (!finds_equilibria) this->refuse_longer(h);
  if (bending_lags()) return take_lagged_step(start, h);
  if (tolerance_ > 0) return take_adaptive_step(start, h);
  take_interval(start, h);
}

// Returns the share of the weight at `time`.  Statics let it grow over the scene's `ramp` and fall over its
// `unload`: the cloth passes through states of equilibrium.
template <class Real, class Device>
double ImplicitIntegrator<Real, Device>::load_fraction(double time) const {
  const Scene& scene = body_.scene;
  if (scene.integrator != Integrator::quasi_static) return 1;
  if (scene.ramp > time) return time / scene.ramp;
  return scene.unload > 0 ? std::max(0.0, 1 - (time - scene.ramp) / scene.unload) : 1;
}

// Rigid pins give way where cloth bars their way; as the last resort, wherever no equilibrium is found with
// them.
template <class Real, class Device>
NewtonOutcome ImplicitIntegrator<Real, Device>::attempt(double start, double h, bool is_first_stage,
                                                        bool is_last_resort) {
  const Real length = static_cast<Real>(h);
  Pins<Real, Device>& pins = body_.pins;
  body_.begin_stage(start, length);
  if (body_.forces_discontinuous) solver_.forget_acceleration();
  const bool yields =
      body_.self_contact && pins.are_blocked(body_, length) && pins.yield_to_cloth(body_, length);
  const NewtonOutcome outcome = solve(start, h, is_first_stage);
  const bool fails = outcome.end == NewtonEnd::blocked || (is_last_resort && !outcome.is_accepted());
  if (!fails || yields || !body_.self_contact || !pins.yield_to_cloth(body_, length)) return outcome;
  return solve(start, h, is_first_stage);
}

template <class Real, class Device>
NewtonOutcome ImplicitIntegrator<Real, Device>::solve(double start, double h, bool is_first_stage) {
  body_.clock.begin(Stage::solve);
  const NewtonOutcome outcome = solver_.solve(h, load_fraction(start + h), is_first_stage);
  body_.clock.end(Stage::solve);
  body_.counts.newton += outcome.iterations;
  body_.counts.linear += outcome.linear_iterations;
  body_.counts.unbalanced += outcome.end == NewtonEnd::unbalanced;
  body_.counts.time_steps += outcome.time_steps;
  last_outcome_ = outcome;
  return outcome;
}

template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::accept(double end) {
  Diagnostics& counts = body_.counts;
  if (last_outcome_.load > 0)
    counts.largest_residual = std::max(counts.largest_residual, last_outcome_.residual / last_outcome_.load);
  if (!solver_.is_static()) {
    ++counts.stages;
    counts.velocities += last_outcome_.velocity;
    counts.largest_velocity = std::max(counts.largest_velocity, last_outcome_.velocity);
  }
  body_.clock.begin(Stage::history);
  solver_.accept();
  body_.clock.end(Stage::history);
  body_.forces_discontinuous = false;
  body_.end_stage(end);
}

// Goes from start to start + h, in halves where that finds no equilibrium.
template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::take_interval(double start, double h) {
  if (const auto failure = take_part({start, h})) take_in_halves(*failure);
}

// Takes what is left of an interval in halves, and in halves of these, down to the shortest parts.
template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::take_in_halves(const Failure& failure) {
  std::vector<Part> ahead;  // the next part is the last
  push_halves(failure, ahead);
  while (!ahead.empty()) {
    const Part part = ahead.back();
    ahead.pop_back();
    if (const auto next = take_part(part)) push_halves(*next, ahead);
  }
  if (body_.self_contact) body_.self_contact->stiffen_parallel_edges(false);
}

// Puts the halves of what is left before all that is ahead; or the same once more, if it is the shortest part
// and stiffer edges may find its equilibrium.  Throws Error::simulation if nothing is left to try.
template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::push_halves(const Failure& failure, std::vector<Part>& ahead) {
  const auto& [start, h, halvings] = failure.rest;
  const bool is_shortest = failure.rest.is_shortest();
  if (is_shortest && (failure.outcome.end == NewtonEnd::blocked || !stiffen_parallel_edges()))
    throw_no_equilibrium(body_, solver_, start, h, failure.outcome);
  ++body_.counts.retried;
  if (is_shortest) {
    ahead.push_back(failure.rest);
  } else {
    ahead.push_back({start + h / 2, h / 2, halvings + 1});
    ahead.push_back({start, h / 2, halvings + 1});
  }
}

template <class Real, class Device>
std::optional<typename ImplicitIntegrator<Real, Device>::Failure> ImplicitIntegrator<Real, Device>::take_part(
    const Part& part) {
  const NewtonOutcome outcome = attempt_first_stage(part);
  if (!outcome.is_accepted()) return Failure{part, outcome};
  return finish_part(part);
}

template <class Real, class Device>
NewtonOutcome ImplicitIntegrator<Real, Device>::attempt_first_stage(const Part& part) {
  return attempt(part.start, first_stage(part.h), solver_.has_two_stages(), part.is_shortest());
}

// Accepts the first stage, which has converged, and takes the second if there is one: each stage leaves a
// state from which steps can start.
template <class Real, class Device>
std::optional<typename ImplicitIntegrator<Real, Device>::Failure>
ImplicitIntegrator<Real, Device>::finish_part(const Part& part) {
  const double first = first_stage(part.h);
  const Part second{part.start + first, part.h - first, part.halvings};
  ++body_.counts.parts;  // before its stages end, which count what they see once a part
  accept(second.start);
  if (!solver_.has_two_stages()) return std::nullopt;
  const NewtonOutcome outcome = attempt(second.start, second.h, false, second.is_shortest());
  if (!outcome.is_accepted()) return Failure{second, outcome};
  accept(second.start + second.h);
  return std::nullopt;
}

// Stiffens parallel edges for the rest of the step; returns whether that is new.  Layers that pressure holds
// edge along edge may leave Newton's method without equilibrium in the shortest part of a step: each of its
// directions turns them too far.
template <class Real, class Device>
bool ImplicitIntegrator<Real, Device>::stiffen_parallel_edges() {
  if (!body_.self_contact || body_.self_contact->stiffens_parallel_edges()) return false;
  body_.self_contact->stiffen_parallel_edges(true);
  return true;
}

// Takes parts whose estimated error stays below the tolerance; a part that does not is taken again, shorter.
template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::take_adaptive_step(double start, double whole) {
  const double end = start + whole, least = whole / (1 << kMaxHalvings);
  if (part_ <= 0) part_ = whole / 16;
  for (double now = start; end - now > least / 2;) {
    const double h = equal_part(end - now, part_);
    const Part part{now, h};
    const NewtonOutcome outcome = attempt_first_stage(part);
    const double error = outcome.is_accepted() ? solver_.local_error() : 1e30;
    const double wanted = next_part(h, std::pow(tolerance_ / error, 1 / solver_.error_order()));
    if (outcome.is_accepted() && error <= tolerance_) {
      if (const auto failure = finish_part(part)) take_in_halves(*failure);
      now += h;
    } else if (wanted < least) {
      throw Error::simulation("tolerance = " + std::to_string(tolerance_) +
                              " m cannot be met at t = " + std::to_string(now) + " s with steps of " +
                              std::to_string(least) + " s or more");
    } else {
      ++body_.counts.retried;
    }
    part_ = wanted;
  }
}

// Takes bending explicitly with its substeps and solves the rest to the end: the line search keeps layers
// apart.  Bending's force is that at the start of a stage, even if the stage is then taken in parts.
template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::take_lagged_step(double start, double whole) {
  for (int k = 0; k < substeps_; ++k) {
    const double from = start + whole * k / substeps_;
    const Real h = static_cast<Real>(whole / substeps_);
    body_.apply_due_events(from, h);
    body_.clock.begin(Stage::bending);
    body_.bending.commit(body_.x.data(), body_.v.data(), h);
    body_.clock.end(Stage::bending);
    take_interval(from, static_cast<double>(h));
  }
}

template class ImplicitIntegrator<double, ThisDevice>;
template class ImplicitIntegrator<float, ThisDevice>;

}  // namespace hysteron
