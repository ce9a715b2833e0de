#include "sim/time/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {

namespace {
constexpr double kEnough = 1e-4;  // share of the predicted decrease that a step has to reach (Armijo 1966)
constexpr int kMaxSearchHalvings = 30;
// The rounding error of a difference of potentials, relative to the terms' magnitudes.
template <class Real>
constexpr double kRounding = sizeof(Real) == 8 ? 1e-14 : 1e-6;
// The rounding of positions.  The force that it causes, stiffness times position times this, may exceed the
// forces that decide, such as those of a thin strip on edge, or the weight of fine cloth in single precision.
// It ends a step only for free cloth without weight, whose forces have nothing else to compare with.
template <class Real>
constexpr double kBlur = sizeof(Real) == 8 ? 1e-16 : 6e-8;
// In single precision rounding alone may keep corrections above that; then predicted decreases of the
// potential no longer fall from one iteration to the next.
constexpr double kIdle = 0.95;
// Corrections below this share of the positions cannot be told from none.
template <class Real>
constexpr double kUnmoved = sizeof(Real) == 8 ? 1e-15 : 5e-7;
// A tiny correction ends a step only where the unbalanced force, over the forces at work, has become small,
// too: a stiffness far above the true one makes any correction small.
template <class Real>
constexpr double kBalanced = sizeof(Real) == 8 ? 1e-3 : 1;

// The loosest linear solve where an iteration costs many of the solver's, as with contact or a factorisation:
// with it falls of a million triangles take a tenth longer, creases a third less.
constexpr double kLoosestOfDear = 0.03;
constexpr double kTightest = 1e-5;

// Tracks the progress of iterations: how tightly the next linear system is worth solving, and which
// corrections would follow.
class Progress {
 public:
  Progress(double loosest, bool has_contact)
      : loosest_(loosest), margin_(has_contact ? kMarginOfContact : 1), forcing_(loosest) {}

  // Returns the relative residual of the next linear solve: it is smaller near the minimum (Eisenstat &
  // Walker 1996, choice 2), but no smaller than needed (Kelley 1995, section 6.3), given the wanted share of
  // the present unbalanced force and the wanted correction [m].
  double tolerance(double wanted_force, double wanted_correction) const {
    constexpr double kShareOfForce = 0.2, kShareOfCorrection = 0.05;
    double least = std::max(kTightest, kShareOfForce * wanted_force);
    if (before_ > 0) least = std::max(least, kShareOfCorrection * wanted_correction / before_);
    return std::min(loosest_, std::max(forcing_, least));
  }
  // Adds the root mean square of a correction [m]; `full`: it was taken in full length.
  void add_correction(double length, bool full) {
    const bool falls = full && before_ > 0 && length < 0.5 * before_;
    left_ = falls ? length * length / (before_ - length) : std::numeric_limits<double>::infinity();
    before_ = full ? length : 0;
  }
  // Adds the unbalanced force after an iteration over that before it.
  void add_ratio(double ratio) { forcing_ = 0.9 * ratio * ratio; }
  // Returns the sum of the corrections that would follow [m]; infinite: unknown.  Corrections of full length,
  // each less than half of the one before, go on as a geometric series: the rest after the last is theta/(1 -
  // theta) of it, theta being the last ratio (Hairer & Wanner 1996, section IV.8).  Contact breaks the series
  // off: with it, the rest counts several times.
  double left() const { return margin_ * left_; }

 private:
  static constexpr double kMarginOfContact = 10;
  double loosest_, margin_, forcing_, before_ = 0, left_ = std::numeric_limits<double>::infinity();
};
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

template <class Real, class Device>
NewtonOutcome Newton<Real, Device>::minimise(Buffer<Vec3<Real>, Device>& x, PotentialValue value,
                                             const char* held, const Real* mass, double total_mass,
                                             double beta_dt) {
  constexpr bool kIsCoarse = sizeof(Real) < sizeof(double);
  const SolverTuning& tuning = limits_.tuning;
  NewtonOutcome outcome;
  const double weight = value.weight, first = value.residual;
  // The longer a step, the more contact it may meet: the next direction is searched only as far as a few
  // times the last step.
  double farthest = std::numeric_limits<double>::infinity();  // [m]
  const double loosest = potential_.has_friction() || solver_.is_direct()
                             ? std::min(kLoosestOfDear, tuning.loosest_solve)
                             : tuning.loosest_solve;
  double shift = limits_.first_shift, rounding = 0;
  double predicted = std::numeric_limits<double>::infinity();  // decrease of the last iteration [J]
  Progress progress(loosest, potential_.has_friction());
  for (;; ++outcome.iterations) {
    outcome.residual = value.residual;
    outcome.velocity = value.residual * beta_dt * std::sqrt(vertices_) / total_mass;
    outcome.load = std::max(std::hypot(weight, value.reaction), value.inertia);
    // Converged: the unbalanced force is small beside the load, is rounding, or would hardly move the cloth
    // within the step.
    const double enough = std::max(limits_.residual * outcome.load, rounding);  // [N]
    const bool arrived = potential_.bodies_have_arrived();
    outcome.converged |= value.residual <= enough || outcome.velocity <= limits_.velocity;
    outcome.converged &= arrived;
    if (outcome.converged || !std::isfinite(value.energy)) break;
    if (outcome.iterations == limits_.iterations) {
      outcome.converged = outcome.unbalanced = limits_.take_unconverged && arrived;
      break;
    }
    const LinearSystem<Real, Device> system = potential_.linearise(
        x.data(), static_cast<Real>(shift), value.residual < tuning.full_stiffness * first);
    const double tolerance = progress.tolerance(enough / value.residual, limits_.velocity * beta_dt);
    outcome.linear_iterations +=
        solver_.solve(system, held, potential_.descent(), direction_.data(), tolerance).iterations;
    const bool is_free = std::hypot(weight, value.reaction) == 0;
    measure_correction(system, x.data(), mass, held, is_free || kIsCoarse);
    const Trial tried = first_try(x.data(), farthest, total_mass);
    const Correction correction = *correction_;
    const double blur = kBlur<Real> * std::sqrt(correction.forces2);
    if (is_free) rounding = blur;
    const bool unmoved = std::sqrt(correction.size2) <= kUnmoved<Real> * std::sqrt(correction.extent2);
    const double before = value.residual;
    const double length = std::sqrt(correction.size2 / total_mass);
    // The rounding of potentials: that of their sum, and that of forces times rounded positions.
    const double extent = std::sqrt(correction.extent2 / total_mass * vertices_);
    const double lost = kRounding<Real> * value.size,
                 blurred = std::max(lost, kBlur<Real> * value.internal * extent);
    const double least_gain = is_free ? blurred : lost;
    const double step_length = search(x, value, tried, correction.slope, blurred);
    if (potential_.has_self_contact()) farthest = tuning.longer * step_length * length;
    outcome.time_steps += step_length;
    const bool balanced =
        value.residual <= kBalanced<Real> * std::hypot(weight, value.reaction, value.internal);
    if (step_length == 0) {
      outcome.converged = arrived && (value.residual <= rounding ||  // or no more to gain:
                                      (balanced && (unmoved || -correction.slope <= least_gain)));
      outcome.unbalanced = !outcome.converged && limits_.take_unconverged && arrived;
      outcome.converged |= outcome.unbalanced;
      outcome.evaluated = false;
      break;
    }
    const bool idle =
        kIsCoarse && step_length == 1 && value.residual <= blur && -correction.slope > kIdle * predicted;
    predicted = -correction.slope;
    progress.add_correction(length, step_length == 1);
    const double left = std::min(length, progress.left());
    outcome.converged = arrived && balanced && shift <= limits_.least_shift &&
                        (unmoved || idle || left / beta_dt <= limits_.velocity);
    shift = std::max(limits_.least_shift, step_length == 1 ? shift / 8 : shift * 2);
    if (potential_.has_friction() && outcome.iterations < tuning.friction_rounds)
      value = potential_.renew_friction(x.data());
    progress.add_ratio(value.residual / before);
  }
  return outcome;
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

template <class Real, class Device>
void Newton<Real, Device>::measure_correction(const LinearSystem<Real, Device>& system, const Vec3<Real>* x,
                                              const Real* mass, const char* held, bool with_forces) {
  const Vec3<Real>*d = direction_.data(), *gradient = potential_.gradient();
  const Mat3<Real>*diagonal = system.matrix.diagonal, *remainder_diagonal = system.rest_diagonal;
  Correction* result = correction_.data();
  for_each_sum<4>(
      device_, {"newton: correction", 3 * direction_.bytes() + vertices_ * sizeof(Real)}, vertices_,
      HYST_KERNEL(int i, Sums<4>& sums) {
        if (held[i]) return;
        sums.term[0] += static_cast<double>(mass[i] * d[i].squaredNorm());
        sums.term[1] += static_cast<double>(gradient[i].dot(d[i]));
        sums.term[2] += static_cast<double>(mass[i] * x[i].squaredNorm());
        if (!with_forces) return;  // the blocks would be most of the data read
        const Real stiffness = diagonal[i].trace() + remainder_diagonal[i].trace();
        sums.term[3] += static_cast<double>(stiffness * stiffness * x[i].squaredNorm());
      },
      HYST_KERNEL(const Sums<4>& total) {
        *result = {total.term[0], total.term[1], total.term[2], total.term[3]};
      });
}

template <class Real, class Device>
void Newton<Real, Device>::place_trial(const Vec3<Real>* x, Real step_length) {
  const Vec3<Real>* d = direction_.data();
  Vec3<Real>* trial = trial_.data();
  for_each(
      device_, {"newton: try", 3 * trial_.bytes()}, vertices_,
      HYST_KERNEL(int i) { trial[i] = x[i] + step_length * d[i]; });
}

template class Newton<double, ThisDevice>;
template class Newton<float, ThisDevice>;

}  // namespace hysteron
