// Decides when Newton's method has found the minimum, and how tightly it solves on the way there.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/scene/scene.h"
#include "sim/time/incremental_potential.h"

namespace hysteron {

// A step has converged when the unbalanced force is small or the last correction was.
struct NewtonLimits {
  // The limit of the unbalanced force's norm over that of the weight and the pins' forces, or of the masses'
  // inertia if that is larger: free cloth without weight has nothing else to compare with.
  double residual = 1e-6;
  // The limit of a root mean square velocity [m/s]: a correction over the step's time, or those that would
  // follow, or that which the unbalanced force would give free masses in the step.
  double velocity = 1e-9;
  int iterations = 60;
  bool take_unconverged = false;  // accepts the state reached by then
  // Statics add the masses times a shift [1/s^2] to the stiffness, which may be singular on the way; the
  // shift falls with every full step and rises with every shortened one.
  double first_shift = 0, least_shift = 0;
  SolverTuning tuning = {};
};

enum class NewtonEnd {
  failed,
  blocked,  // the pins' own motion leads the cloth through itself
  converged,
  unbalanced,  // accepted unconverged
};

struct NewtonOutcome {
  NewtonEnd end = NewtonEnd::failed;
  bool evaluated = true;  // the potential was last evaluated at the result
  int iterations = 0;
  long linear_iterations = 0;
  double time_steps = 0;  // sum of step lengths, 1 for a full step
  double residual = 0;    // norm of the unbalanced force [N]
  double load = 0;        // weight and reactions, or inertia if that is larger [N]
  double velocity = 0;    // root mean square that the residual gives free masses in the step [m/s]

  bool is_accepted() const { return end == NewtonEnd::converged || end == NewtonEnd::unbalanced; }
};

// Sums over the free vertices of a correction d of the positions x.
struct CorrectionSums {
  double size2;    // sum of m |d|^2 [kg m^2]
  double slope;    // gradient . d [J]
  double extent2;  // sum of m |x|^2 [kg m^2]
  // Sum of (trace of the stiffness times |x|)^2, whose rounding no force escapes, for free cloth [N^2].
  double forces2;
};

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
    constexpr double kTightest = 1e-5, kShareOfForce = 0.2, kShareOfCorrection = 0.05;
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

// Follows the iterations of one minimisation.  Each of them calls weigh() with the potential's value, then
// end_at_iterate(); with a direction found, measure(), which the line search needs; then end_at_standstill()
// if no step lowers the potential, else add_step() and begin_next().
template <class Real>
class Convergence {
 public:
  // The `first` value is that where the minimisation begins; `expensive`: an iteration costs many of the
  // linear solver's.
  Convergence(const NewtonLimits& limits, const PotentialValue& first, int vertices, double total_mass,
              double beta_dt, bool has_contact, bool expensive)
      : limits_(limits),
        vertices_(vertices),
        total_mass_(total_mass),
        beta_dt_(beta_dt),
        weight_(first.weight),
        first_residual_(first.residual),
        shift_(limits.first_shift),
        progress_(expensive ? std::min(kLoosestOfExpensive, limits.tuning.loosest_solve)
                            : limits.tuning.loosest_solve,
                  has_contact) {}

  // Compares the forces at an iterate with what is at work there.
  void weigh(const PotentialValue& value) {
    is_finite_ = std::isfinite(value.energy);
    is_free_ = std::hypot(weight_, value.reaction) == 0;
    residual_ = value.residual;
    velocity_ = value.residual * beta_dt_ * std::sqrt(vertices_) / total_mass_;
    load_ = std::max(std::hypot(weight_, value.reaction), value.inertia);
    enough_ = std::max(limits_.residual * load_, rounding_);
  }
  // Returns how the minimisation ends at the iterate; nothing: it goes on.  It has converged if the
  // unbalanced force is small beside the load, is rounding, or would hardly move the cloth within the step,
  // or if the last correction was small; `arrived`: bodies are where the step takes them.
  std::optional<NewtonEnd> end_at_iterate(int iterations, bool arrived) const {
    const bool small_force = residual_ <= enough_ || velocity_ <= limits_.velocity;
    if (arrived && (small_force || small_correction_)) return NewtonEnd::converged;
    if (!is_finite_) return NewtonEnd::failed;
    if (iterations == limits_.iterations) return unconverged(arrived);
    return std::nullopt;
  }

  Real shift() const { return static_cast<Real>(shift_); }
  // Is the iterate so near the minimum that the whole stiffness, softening included, leads there?
  bool is_near() const { return residual_ < limits_.tuning.full_stiffness * first_residual_; }
  double solve_tolerance() const {
    return progress_.tolerance(enough_ / residual_, limits_.velocity * beta_dt_);
  }
  // Does measure() need the sum of forces?
  bool needs_forces() const { return is_free_ || kIsCoarse; }

  // Compares a correction, and what it promises, with rounding at the iterate of this value.
  void measure(const CorrectionSums& correction, const PotentialValue& value) {
    length_ = std::sqrt(correction.size2 / total_mass_);
    promised_before_ = promised_;
    promised_ = -correction.slope;
    unmoved_ = std::sqrt(correction.size2) <= kUnmoved * std::sqrt(correction.extent2);
    blur_ = kBlur * std::sqrt(correction.forces2);
    if (is_free_) rounding_ = blur_;
    // The rounding of potentials: that of their sum, and that of forces times rounded positions.
    const double extent = std::sqrt(correction.extent2 / total_mass_ * vertices_);
    const double lost = kRounding * value.size;
    blurred_potential_ = std::max(lost, kBlur * value.internal * extent);
    least_gain_ = is_free_ ? blurred_potential_ : lost;
  }
  double length() const { return length_; }                        // root mean square of the correction [m]
  double blurred_potential() const { return blurred_potential_; }  // rounding hides smaller differences [J]

  // Returns how the minimisation ends at an iterate that no step along the correction improves.
  NewtonEnd end_at_standstill(const PotentialValue& value, bool arrived) const {
    const bool nothing_to_gain = is_balanced(value) && (unmoved_ || promised_ <= least_gain_);
    if (arrived && (value.residual <= rounding_ || nothing_to_gain)) return NewtonEnd::converged;
    return unconverged(arrived);
  }

  // Adds a step of this length, 1 for a full one, along the correction to an iterate of this value. `arrived`
  // is as before the step: one that takes bodies along shows nothing, however short.
  void add_step(double step_length, const PotentialValue& value, bool arrived) {
    const bool full = step_length == 1;
    const bool idle = kIsCoarse && full && value.residual <= blur_ && promised_ > kIdle * promised_before_;
    progress_.add_correction(length_, full);
    const double left = std::min(length_, progress_.left());
    small_correction_ = arrived && is_balanced(value) && shift_ <= limits_.least_shift &&
                        (unmoved_ || idle || left / beta_dt_ <= limits_.velocity);
    shift_ = std::max(limits_.least_shift, full ? shift_ / 8 : shift_ * 2);
  }
  // Ends the iteration with the unbalanced force [N] after its step, and after new limits of friction.
  void begin_next(double residual) { progress_.add_ratio(residual / residual_); }

  // Fills in the forces at the last iterate.
  void report(NewtonOutcome& outcome) const {
    outcome.residual = residual_;
    outcome.load = load_;
    outcome.velocity = velocity_;
  }

 private:
  // The loosest linear solve where an iteration costs many of the solver's, as with contact or a
  // factorisation: with it falls of a million triangles take a tenth longer, creases a third less.
  static constexpr double kLoosestOfExpensive = 0.03;
  static constexpr bool kIsCoarse = sizeof(Real) < sizeof(double);
  // The rounding error of a difference of potentials, relative to the terms' magnitudes.
  static constexpr double kRounding = kIsCoarse ? 1e-6 : 1e-14;
  // The rounding of positions.  The force that it causes, stiffness times position times this, may exceed the
  // forces that decide, such as those of a thin strip on edge, or the weight of fine cloth in single
  // precision. It ends a step only for free cloth without weight, whose forces have nothing else to compare
  // with.
  static constexpr double kBlur = kIsCoarse ? 6e-8 : 1e-16;
  // In single precision rounding alone may keep corrections above that; then predicted decreases of the
  // potential no longer fall from one iteration to the next.
  static constexpr double kIdle = 0.95;
  // Corrections below this share of the positions cannot be told from none.
  static constexpr double kUnmoved = kIsCoarse ? 5e-7 : 1e-15;
  // A tiny correction ends a step only where the unbalanced force, over the forces at work, has become small,
  // too: a stiffness far above the true one makes any correction small.
  static constexpr double kBalanced = kIsCoarse ? 1 : 1e-3;

  NewtonEnd unconverged(bool arrived) const {
    return limits_.take_unconverged && arrived ? NewtonEnd::unbalanced : NewtonEnd::failed;
  }
  bool is_balanced(const PotentialValue& value) const {
    return value.residual <= kBalanced * std::hypot(weight_, value.reaction, value.internal);
  }

  const NewtonLimits& limits_;
  int vertices_;
  double total_mass_, beta_dt_;     // [kg], [s]
  double weight_, first_residual_;  // of the cloth, and of the first iterate [N]
  double shift_;                    // [1/s^2]
  Progress progress_;
  bool small_correction_ = false;  // the last step was so short that it may end the minimisation
  double rounding_ = 0;            // the unbalanced force of free cloth that is rounding [N]
  // These are of the present iterate.
  bool is_finite_ = true, is_free_ = false;                     // is_free_: neither weight nor pins act
  double residual_ = 0, velocity_ = 0, load_ = 0, enough_ = 0;  // [N], [m/s], [N], [N]
  // These are of the correction from there.
  bool unmoved_ = false;
  double length_ = 0, blur_ = 0;                               // [m], force of rounded positions [N]
  double promised_ = std::numeric_limits<double>::infinity();  // decrease of the potential [J]
  double promised_before_ = std::numeric_limits<double>::infinity();
  double blurred_potential_ = 0, least_gain_ = 0;  // [J]
};

}  // namespace hysteron
