// Takes one implicit step: backward Euler, two-step backward differences (bdf2), a stage of tr-bdf2, or
// equilibrium (quasi-static).
//
// tr-bdf2 (Bank et al. 1985) is the trapezoidal rule over gamma h with gamma = 2 - sqrt 2, then bdf2 from the
// step's start and that stage over the rest; it is L-stable and of second order, and both stages have the
// same beta h.  Each is accepted with its own history, contact, pins and obstacles.  The trapezoidal rule
// takes the acceleration at the start, that is all forces there, from the solution of the stage before: no
// force is evaluated anew.  Where none is known, at the start and after a jump of forces, the first stage is
// backward Euler's, which keeps the order.
//
// In `semi-implicit` with self-contact bending lags: its force is that of the state accepted last.
#pragma once

#include <memory>
#include <optional>

#include "sim/time/body.h"
#include "sim/time/newton.h"

namespace hysteron {

// The forces on a vertex beside weight and air [N].
template <class Real>
struct VertexForces {
  Vec3<Real> bending, pins, remainder;  // `pins`: compliant ones, and support of the missing weight

  HYST_HD Vec3<Real> sum() const { return bending + pins + remainder; }
  HYST_HD VertexForces mean(const VertexForces& other) const {
    const Real half = Real(0.5);
    return {half * (bending + other.bending), half * (pins + other.pins),
            half * (remainder + other.remainder)};
  }
};

// The guess at which Newton's method begins: constant velocity, the acceleration of the step before, or that
// acceleration extrapolated from its change over the two steps before.
enum class Guess { steady, accelerated, extrapolated };

// The vertex that is farthest from equilibrium.
struct Unbalanced {
  int vertex = -1;
  double force = 0;                   // [N]
  Eigen::Vector3d position{0, 0, 0};  // [m]
};

inline constexpr double kTrapezoidalFraction = 0.58578643762690495;  // of tr-bdf2's step: 2 - sqrt 2

// A stage of a step goes from the state accepted last to the next one in this order:
//
//   solve()        predict, guess the end, minimise the potential: finds the end, and changes no lasting
//   state local_error()  if the caller wants to know it accept()       commit the laws' histories, update the
//   ledger over the way, commit the state
//
// A caller that does not like the end that solve() has found, or whose solve() has failed, calls solve()
// again with another h.  accept() and local_error() throw std::bad_optional_access unless solve() has just
// found an end.
template <class Real, class Device>
class ImplicitStep {
 public:
  explicit ImplicitStep(Body<Real, Device>& body);

  // Finds the positions after h [s].  `fraction` of the weight acts at the end.  The first stage of tr-bdf2
  // is its trapezoidal one.
  NewtonOutcome solve(double h, double fraction, bool is_first_stage);
  bool is_static() const { return static_; }
  bool has_two_stages() const { return two_stage_; }  // tr-bdf2
  // Makes the next step start without the last acceleration, after forces have jumped.
  void forget_acceleration() { knows_acceleration_ = false; }
  // Makes steps equilibria from now on.
  void become_static();
  // Commits the end that solve() has found: positions, velocities, history of bending and membrane, losses.
  // The caller commits contact's history.
  void accept();
  // Returns the estimated error of the positions that solve() has found, by the difference from an
  // extrapolation: root mean square by mass [m].  It is of the order error_order() in the step.
  double local_error();
  double error_order() const { return formula_.extrapolation > 0 || formula_.carried > 0 ? 3 : 2; }
  // Saves or loads the state that outlives a step: the motion before it, and the forces that pin_forces()
  // returns.
  void serialise(Archive& archive) {
    archive(knows_acceleration_, last_h_, knows_trend_);
    for (Guess& favourite : favourite_) archive(favourite);
    hysteron::serialise(archive, *body_.device, acceleration_, acceleration_before_, x_before_, v_before_);
    archive(knows_forces_);
    hysteron::serialise(archive, *body_.device, forces_);
    potential_.serialise(archive);
    solver_->serialise(archive);
  }
  // Returns the forces of the pins on held vertices [N], for the step accepted last; zero on free vertices.
  std::vector<Vec3<Real>> pin_forces() const;
  // Returns where solve() has failed to converge.
  Unbalanced most_unbalanced();
  // Returns which part of the potential is not finite at the start, in a user's words; "" if none.
  std::string not_finite() { return potential_.not_finite(body_.x.data()); }
  std::size_t bytes() const {
    return potential_.bytes() + solver_->bytes() + newton_.bytes() + 6 * end_.bytes() +
           2 * x_before_.bytes() + displacement_.bytes() + forces_.bytes();
  }

  // An end that solve() has found and accept() has not taken yet.
  struct Solution {
    StepFormula formula;
    Real fraction;   // acting share of the weight
    bool evaluated;  // the potential was last evaluated there
  };
  // The parts of solve(), and of accept(), which alone has a solution; public because nvcc allows no device
  // lambda in a private member function.
  void predict();
  void guess(Guess which);
  void shorten_guess(Real step_length);
  void update_ledger(const Solution& solution);
  void commit_state(const Solution& solution);

 private:
  static constexpr double kMaxGrowth = 2.4;  // over the last step; bdf2 is stable below 1 + sqrt2
  StepFormula step_formula(double h, bool is_first_stage) const {
    if (static_ || !is_first_stage) return rate_formula(h);
    return knows_acceleration_ ? StepFormula::trapezoidal(h) : StepFormula::backward_euler(h);
  }
  StepFormula rate_formula(double h) const {
    if (static_) return StepFormula::statics(h);
    const bool two_steps = two_step_ && last_h_ > 0 && h <= kMaxGrowth * last_h_;
    return two_steps ? StepFormula::bdf2(h, last_h_) : StepFormula::backward_euler(h);
  }
  PotentialValue begin_at_best_guess(bool is_first_stage);
  bool limit_guess_by_ccd();
  PotentialValue potential_of_guess(Guess which);
  std::size_t vectors(int count) const { return count * end_.bytes(); }

  Body<Real, Device>& body_;
  bool two_step_, two_stage_, static_, bending_lags_;
  bool knows_acceleration_ = false;  // acceleration_ is that of the state accepted last
  double total_mass_;
  IncrementalPotential<Real, Device> potential_;
  std::unique_ptr<LinearSolver<Real, Device>> solver_;
  Newton<Real, Device> newton_;
  StepFormula formula_;               // of the last solve()
  std::optional<Solution> solution_;  // of the last solve(), if it has found one
  double last_h_ = 0;                 // length of the step before [s]; 0: none
  Buffer<double, Device> size_;
  Buffer<Vec3<Real>, Device> end_;                            // the positions sought [m]
  Buffer<Vec3<Real>, Device> reference_, drift_, predicted_;  // r [m], its velocity [m/s], y [m]
  // The acceleration over the step before [m/s^2], in tr-bdf2 at its end; in statics the velocity of the load
  // [m/s].
  Buffer<Vec3<Real>, Device> acceleration_, acceleration_before_;
  bool knows_trend_ = false;                                         // acceleration_before_ is that of a step
  Guess favourite_[2] = {Guess::extrapolated, Guess::extrapolated};  // each stage's best last time
  Buffer<Vec3<Real>, Device> x_before_, v_before_;  // of the step or stage before, for bdf2 and tr-bdf2
  Buffer<Vec3<Real>, Device> displacement_;         // to a guess [m]; with self-contact only
  bool knows_forces_ = false;
  Buffer<VertexForces<Real>, Device> forces_;  // at the state accepted last, for quasi-static scenes
};

}  // namespace hysteron
