// One implicit step: backward Euler, two-step backward differences (bdf2), a stage of tr-bdf2, or equilibrium
// (quasi-static).
//
// tr-bdf2 (Bank et al. 1985): the trapezoidal rule over gamma h with gamma = 2 - sqrt 2, then bdf2 from the
// step's start and that stage over the rest; L-stable, of second order, and both stages have the same beta h.
// Each is accepted with its own history, contact, hands and obstacles.  The trapezoidal rule takes over the
// acceleration at the start, that is all forces there, from the stage before, where it was the solution: no
// force is evaluated anew.  Where none is known, at the start and after a jump of forces, the first stage is
// backward Euler's, which keeps the order.
//
// In `semi-implicit` with self-contact bending lags: its force is that of the state accepted last.
#pragma once

#include <memory>

#include "sim/time/body.h"
#include "sim/time/newton.h"

namespace hysteron {

// What acts on a vertex beside its weight and air [N].
template <class Real>
struct VertexForces {
  Vec3<Real> bending, pins, remainder;  // hands: weak ones, and the one that lets the cloth down

  HYST_HD Vec3<Real> sum() const { return bending + pins + remainder; }
  HYST_HD VertexForces mean(const VertexForces& other) const {
    const Real half = Real(0.5);
    return {half * (bending + other.bending), half * (pins + other.pins),
            half * (remainder + other.remainder)};
  }
};

// Where Newton's method begins: at the velocity that was, with the acceleration of the step before, or with
// that and how it changed over the two steps before.
enum class Guess { steady, accelerated, extrapolated };

// The vertex that is farthest from equilibrium.
struct Unbalanced {
  int vertex = -1;
  double force = 0;  // [N]
  Eigen::Vector3d position{0, 0, 0};
};

inline constexpr double kTrapezoidalFraction = 0.58578643762690495;  // of a step of tr-bdf2: 2 - sqrt 2

template <class Real, class Device>
class ImplicitStep {
 public:
  explicit ImplicitStep(Body<Real, Device>& body);

  // Looks for the positions after h [s]; changes nothing that lasts.  `fraction` of the weight acts at the
  // end. The first stage of tr-bdf2 is its trapezoidal one.
  NewtonOutcome solve(double h, double fraction, bool is_first_stage);
  bool is_static() const { return static_; }
  bool has_two_stages() const { return two_stage_; }  // tr-bdf2
  // Forces have forces_discontinuous: the acceleration that was is not the one to go on with.
  void forget_acceleration() { knows_acceleration_ = false; }
  // Steps are equilibria from now on.
  void become_static();
  // Takes what solve() has found: positions, velocities, history of bending and membrane, losses.  Contact's
  // history is the caller's.
  void accept();
  // Estimated error of the positions that solve() has found, by the difference from an extrapolation: root
  // mean square by mass [m].  It is of the order error_order() in the step.
  double local_error();
  double error_order() const { return formula_.extrapolation > 0 || formula_.carried > 0 ? 3 : 2; }
  // What outlives a step: motion before it, and the forces that handle_forces() tells of.
  void serialise(Archive& archive) {
    archive(knows_acceleration_, last_h_, knows_trend_);
    for (Guess& favourite : favourite_) archive(favourite);
    hysteron::serialise(archive, *body_.device, acceleration_, acceleration_before_, x_before_, v_before_);
    archive(knows_forces_);
    hysteron::serialise(archive, *body_.device, forces_);
    potential_.serialise(archive);
    solver_->serialise(archive);
  }
  // Forces of the handles on held vertices, of the step accepted last; zero on free ones [N].
  std::vector<Vec3<Real>> handle_forces() const;
  // Where solve() has ended without success.
  Unbalanced most_unbalanced();
  // Which part of the potential is not finite at the start, in a user's words; "" if none.
  std::string not_finite() { return potential_.not_finite(body_.x.data()); }
  std::size_t bytes() const {
    return potential_.bytes() + solver_->bytes() + newton_.bytes() + 6 * end_.bytes() +
           2 * x_before_.bytes() + displacement_.bytes() + forces_.bytes();
  }

  // The parts; public because nvcc allows no device lambda in a private member function.
  void place();
  void guess(Guess which);
  bool keep_apart();
  void shorten_guess(Real step_length);
  void book();
  void move_on();

 private:
  static constexpr double kMaxGrowth = 2.4;  // of a step over the one before; bdf2 is stable below 1 + sqrt2
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
  PotentialValue potential_of_guess(Guess which);
  std::size_t vectors(int count) const { return count * end_.bytes(); }

  Body<Real, Device>& body_;
  bool two_step_, two_stage_, static_, bending_lags_;
  bool knows_acceleration_ = false;  // at the state accepted last
  bool evaluated_ = false;           // the potential was last, at the end of the solve
  Real fraction_ = 1;                // of the weight
  double total_mass_;
  IncrementalPotential<Real, Device> potential_;
  std::unique_ptr<LinearSolver<Real, Device>> solver_;
  Newton<Real, Device> newton_;
  StepFormula formula_;
  double last_h_ = 0;  // of the step before; 0: none
  Buffer<double, Device> size_;
  Buffer<Vec3<Real>, Device> end_;  // positions looked for
  Buffer<Vec3<Real>, Device> reference_, drift_,
      predicted_;  // r [m], velocity that goes with it [m/s], y [m]
  // Over the step before: acceleration [m/s^2]; in tr-bdf2 that at its end; in statics the velocity of the
  // load [m/s].
  Buffer<Vec3<Real>, Device> acceleration_, acceleration_before_;
  bool knows_trend_ = false;                                         // acceleration_before_ is that of a step
  Guess favourite_[2] = {Guess::extrapolated, Guess::extrapolated};  // the best one last time, of each stage
  Buffer<Vec3<Real>, Device> x_before_, v_before_;  // of the step or stage before; bdf2 and tr-bdf2
  Buffer<Vec3<Real>, Device> displacement_;         // to a guess; with self-contact only
  bool knows_forces_ = false;
  Buffer<VertexForces<Real>, Device> forces_;  // at the state accepted last; of quasi-static scenes
};

}  // namespace hysteron
