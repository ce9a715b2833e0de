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
  take_interval(start, h, 0);
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

template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::take_interval(double start, double h, int halvings) {
  const NewtonOutcome outcome =
      attempt(start, first_stage(h), solver_.has_two_stages(), halvings == kMaxHalvings);
  outcome.is_accepted() ? finish(start, h, halvings) : take_halves(start, h, halvings, outcome);
}

// Accepts the first stage and takes the rest of the way: each stage leaves a state from which steps can
// start.
template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::finish(double start, double h, int halvings) {
  const double first = first_stage(h), remainder = h - first;
  accept(start + first);
  ++body_.counts.parts;
  if (!solver_.has_two_stages()) return;
  const NewtonOutcome outcome = attempt(start + first, remainder, false, halvings == kMaxHalvings);
  outcome.is_accepted() ? accept(start + first + remainder)
                        : take_halves(start + first, remainder, halvings, outcome);
}

template <class Real, class Device>
void ImplicitIntegrator<Real, Device>::take_halves(double start, double h, int halvings,
                                                   const NewtonOutcome& outcome) {
  const bool is_shortest = halvings == kMaxHalvings;
  if (is_shortest && (outcome.end == NewtonEnd::blocked || !stiffen_parallel_edges()))
    throw_if_unbalanced(body_, solver_, start, h, outcome);
  ++body_.counts.retried;
  if (is_shortest) return take_interval(start, h, halvings);
  take_interval(start, h / 2, halvings + 1);
  take_interval(start + h / 2, h / 2, halvings + 1);
  if (halvings == 0 && body_.self_contact) body_.self_contact->stiffen_parallel_edges(false);
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
    const NewtonOutcome outcome = attempt(now, first_stage(h), solver_.has_two_stages(), false);
    const double error = outcome.is_accepted() ? solver_.local_error() : 1e30;
    const double wanted = next_part(h, std::pow(tolerance_ / error, 1 / solver_.error_order()));
    if (outcome.is_accepted() && error <= tolerance_) {
      finish(now, h, 0);
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
    take_interval(from, static_cast<double>(h), 0);
  }
}

template class ImplicitIntegrator<double, ThisDevice>;
template class ImplicitIntegrator<float, ThisDevice>;

}  // namespace hysteron
