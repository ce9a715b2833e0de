#include "sim/time/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {

namespace {
constexpr double kEnough = 1e-4;  // share of the predicted decrease that a step has to reach (Armijo 1966)
constexpr int kMaxSearchHalvings = 30;

// Sums over the vertices that are not held; `with_forces`: all sums, else all but that of forces.  Arrays
// have `vertices` elements: the correction [m] of the positions x [m], and their masses [kg].
template <class Real, class Device>
void sum_correction(Device& device, int vertices, const LinearSystem<Real, Device>& system,
                    const Vec3<Real>* gradient, const Vec3<Real>* correction, const Vec3<Real>* x,
                    const Real* mass, const char* held, bool with_forces, CorrectionSums* result) {
  const Mat3<Real>*diagonal = system.matrix.diagonal, *remainder_diagonal = system.rest_diagonal;
  for_each_sum<4>(
      device, {"newton: correction", vertices * (3 * sizeof(Vec3<Real>) + sizeof(Real))}, vertices,
      HYST_KERNEL(int i, Sums<4>& sums) {
        if (held[i]) return;
        sums.term[0] += static_cast<double>(mass[i] * correction[i].squaredNorm());
        sums.term[1] += static_cast<double>(gradient[i].dot(correction[i]));
        sums.term[2] += static_cast<double>(mass[i] * x[i].squaredNorm());
        if (!with_forces) return;  // the blocks would be most of the data read
        const Real stiffness = diagonal[i].trace() + remainder_diagonal[i].trace();
        sums.term[3] += static_cast<double>(stiffness * stiffness * x[i].squaredNorm());
      },
      HYST_KERNEL(const Sums<4>& total) {
        *result = {total.term[0], total.term[1], total.term[2], total.term[3]};
      });
}

// Sets `trial` to x + step_length * direction, arrays of `vertices` elements [m].
template <class Real, class Device>
void place_trial(Device& device, int vertices, const Vec3<Real>* x, Real step_length,
                 const Vec3<Real>* direction, Vec3<Real>* trial) {
  for_each(
      device, {"newton: try", 3 * vertices * sizeof(Vec3<Real>)}, vertices,
      HYST_KERNEL(int i) { trial[i] = x[i] + step_length * direction[i]; });
}
}  // namespace

template <class Real, class Device>
Newton<Real, Device>::Newton(Device& device, int vertices, IncrementalPotential<Real, Device>& potential,
                             LinearSolver<Real, Device>& solver, const NewtonLimits& limits)
    : device_(device),
      vertices_(vertices),
      potential_(potential),
      solver_(solver),
      limits_(limits),
      direction_(device, vertices),
      trial_(device, vertices),
      correction_(device) {}

// From iterate to iterate: is the potential at its minimum here?  If not, which correction leads there, and
// which step along it lowers the potential enough?
template <class Real, class Device>
NewtonOutcome Newton<Real, Device>::minimise(Buffer<Vec3<Real>, Device>& x, PotentialValue value,
                                             const char* held, const Real* mass, double total_mass,
                                             double beta_dt) {
  const bool has_contact = potential_.has_friction();
  Convergence<Real> convergence(limits_, value, vertices_, total_mass, beta_dt, has_contact,
                                has_contact || solver_.is_direct());
  NewtonOutcome outcome;
  // The longer a step, the more contact it may meet: the next direction is searched only as far as a few
  // times the last step.
  double farthest = std::numeric_limits<double>::infinity();  // [m]
  for (;; ++outcome.iterations) {
    const bool arrived = potential_.bodies_have_arrived();
    convergence.weigh(value);
    if (const auto end = convergence.end_at_iterate(outcome.iterations, arrived)) {
      outcome.end = *end;
      break;
    }
    const LinearSystem<Real, Device> system =
        potential_.linearise(x.data(), convergence.shift(), convergence.is_near());
    outcome.linear_iterations +=
        solver_.solve(system, held, potential_.descent(), direction_.data(), convergence.solve_tolerance())
            .iterations;
    sum_correction(device_, vertices_, system, potential_.gradient(), direction_.data(), x.data(), mass, held,
                   convergence.needs_forces(), correction_.data());
    const Trial first = first_try(x.data(), farthest, total_mass);  // from here on the host knows the sums
    convergence.measure(*correction_, value);
    const double step_length = search(x, value, first, (*correction_).slope, convergence.blurred_potential());
    outcome.time_steps += step_length;
    if (step_length == 0) {
      outcome.end = convergence.end_at_standstill(value, arrived);
      outcome.evaluated = false;
      break;
    }
    if (potential_.has_self_contact()) farthest = limits_.tuning.longer * step_length * convergence.length();
    convergence.add_step(step_length, value, arrived);
    if (has_contact && outcome.iterations < limits_.tuning.friction_rounds)
      value = potential_.renew_friction(x.data());
    convergence.begin_next(value.residual);
  }
  convergence.report(outcome);
  return outcome;
}

template <class Real, class Device>
typename Newton<Real, Device>::Trial Newton<Real, Device>::try_step(const Vec3<Real>* x, double step_length) {
  place_trial<Real>(device_, vertices_, x, static_cast<Real>(step_length), direction_.data(), trial_.data());
  potential_.take_bodies(step_length);
  return {step_length, potential_.evaluate(trial_.data(), direction_.data())};
}

// Makes the first trial step.  A `full` system includes the membrane's softening under compression; where the
// stiffness is indefinite the direction leads down along its negative curvature, away from the saddle.
// Otherwise the stiffness is positive.  Longva et al. 2023 compare such choices.
//
// Only where layers limit the step by its length does the host have to know the correction before the trial.
template <class Real, class Device>
typename Newton<Real, Device>::Trial Newton<Real, Device>::first_try(const Vec3<Real>* x, double farthest,
                                                                     double total_mass) {
  double max_step = 1;
  if (potential_.has_self_contact()) {
    device_.synchronize();
    if (!((*correction_).slope < 0) && potential_.bodies_have_arrived()) return {};
    max_step = std::min(1.0, farthest / std::sqrt((*correction_).size2 / total_mass));
  }
  const double step_length = potential_.feasible_step(x, direction_.data(), max_step);
  if (step_length > 0) return try_step(x, step_length);
  device_.synchronize();
  return {};
}

// Takes the first step along the direction, as long as is feasible or shorter, that lowers the potential
// enough, and returns its length; 0 if there is none.  Where the difference is within rounding, the slope
// must have become flatter instead (Hager & Zhang 2005).  A step that moves bodies along goes from one
// potential to another: it is taken unchecked.
template <class Real, class Device>
double Newton<Real, Device>::search(Buffer<Vec3<Real>, Device>& x, PotentialValue& value, Trial tried,
                                    double slope, double blurred) {
  const bool arrived = potential_.bodies_have_arrived();
  if ((!(slope < 0) && arrived) || !(tried.length > 0)) return 0;
  for (int halving = 1;; ++halving) {
    const double step_length = tried.length;
    const double rise = tried.value.energy - value.energy;
    const bool lower = rise <= kEnough * step_length * slope,
               flatter = std::abs(rise) <= blurred && std::abs(tried.value.slope) <= -0.9 * slope;
    if (lower || flatter || (!arrived && std::isfinite(tried.value.energy))) {
      std::swap(x, trial_);
      potential_.accept_iterate(x.data());
      value = tried.value;
      return step_length;
    }
    if (halving == kMaxSearchHalvings) return 0;
    const double curved = 2 * (rise - step_length * slope);  // for the known parabola's minimum
    const double next = curved > 0 ? -slope * step_length * step_length / curved : 0;
    tried = try_step(x.data(),
                     std::clamp(std::isfinite(next) ? next : 0.0, 0.1 * step_length, 0.5 * step_length));
  }
}

template class Newton<double, ThisDevice>;
template class Newton<float, ThisDevice>;

}  // namespace hysteron
