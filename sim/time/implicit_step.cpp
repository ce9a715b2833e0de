// The ledger: over a displacement d = x_{n+1} - x_n all forces together do the work m a.d, where the
// acceleration is a = (v_{n+1} - v^)/beta_dt with v^ the formula's combination of older velocities.  The part
// of it that does not become kinetic energy,
//   m a.d - m (|v_{n+1}|^2 - |v_n|^2)/2,   in backward Euler m |dv|^2/2,
// the integrator has taken away; so it has, of each energy, the gap between its change and the work of its
// forces at x_{n+1}: W_n - W_{n+1} - W'_{n+1}.(x_n - x_{n+1}).  Quasi-static scenes go through equilibria:
// there the work is that of the mean of the forces at both ends, whose gap is of third order in a smooth
// step.  The gaps that remain are jumps from one equilibrium to another.
#include "sim/time/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/linear/levels_in_one_launch.h"
#include "sim/time/make_linear_solver.h"

namespace hysteron {

namespace {

template <class Real>
NewtonLimits newton_limits(const Scene& scene, bool statics) {
  NewtonLimits limits;
  limits.tuning = scene.tuning;
  limits.residual = scene.newton_residual;
  // Single precision resolves positions of a metre to 6e-8 m.
  constexpr double kMinVelocity = sizeof(Real) == 8 ? 0 : 1e-5;
  limits.velocity = std::max(scene.newton_velocity, kMinVelocity);
  if (statics && scene.integrator != Integrator::quasi_static) {
    // The error of steps in time hides a loose tolerance; the equilibrium after them needs a tight one.
    limits.residual = std::min(limits.residual, 1e-6);
    limits.velocity = std::max(std::min(scene.newton_velocity, 1e-9), kMinVelocity);
  }
  if (statics) {
    limits.iterations = 400;
    // After a motion, parts of a step find no other equilibrium: the caller sees whether cloth still moves.
    limits.take_unconverged = scene.integrator != Integrator::quasi_static;
    limits.first_shift = 1e4;  // as in a step of 10 ms
    limits.least_shift = 1e-4;
  } else if (scene.newton_iterations > 0) {
    limits.iterations = scene.newton_iterations;
    limits.take_unconverged = true;
  }
  return limits;
}

}  // namespace

template <class Real, class Device>
ImplicitStep<Real, Device>::ImplicitStep(Body<Real, Device>& body)
    : body_(body),
      two_step_(body.scene.integrator == Integrator::bdf2 || body.scene.integrator == Integrator::tr_bdf2),
      two_stage_(body.scene.integrator == Integrator::tr_bdf2),
      static_(body.scene.integrator == Integrator::quasi_static),
      bending_lags_(body.scene.integrator == Integrator::semi_implicit),
      total_mass_(body.mass.sum()),
      potential_(*body.device, body.matrix, body.membrane, body.bending,
                 body.contact ? &*body.contact : nullptr, body.self_contact ? &*body.self_contact : nullptr,
                 body.mass, bending_lags_, body.scene.tuning),
      solver_(make_linear_solver(body)),
      newton_(*body.device, body.vertices, potential_, *solver_, newton_limits<Real>(body.scene, static_)),
      size_(*body.device, 1),
      end_(*body.device, body.vertices),
      reference_(*body.device, body.vertices),
      drift_(*body.device, body.vertices),
      predicted_(*body.device, body.vertices),
      acceleration_(*body.device, body.vertices),
      acceleration_before_(*body.device, body.vertices),
      x_before_(*body.device, two_step_ ? body.vertices : 0),
      v_before_(*body.device, two_step_ ? body.vertices : 0),
      displacement_(*body.device, body.self_contact ? body.vertices : 0),
      forces_(*body.device, static_ ? body.vertices : 0) {
  // A solve in one launch takes the whole matrix.
  if (Device::kGpu && !bending_lags_ && body.vertices <= kMaxRowsInOneLaunch) potential_.assemble();
}

template <class Real, class Device>
void ImplicitStep<Real, Device>::become_static() {
  static_ = true;
  two_step_ = two_stage_ = false;
  newton_.set_limits(newton_limits<Real>(body_.scene, true));
  last_h_ = 0;  // past velocities are no guess for statics
}

template <class Real, class Device>
NewtonOutcome ImplicitStep<Real, Device>::solve(double h, double fraction, bool is_first_stage) {
  solution_.reset();
  formula_ = step_formula(h, is_first_stage);
  if (is_first_stage || !two_stage_) solver_->begin();
  const Real share = static_cast<Real>(fraction);
  predict();
  potential_.begin({formula_, rate_formula(h), body_.x.data(), x_before_.data(), reference_.data(),
                    predicted_.data(), body_.held.data(), body_.gravity(), body_.drag(), share,
                    body_.pins.compliant_pins()});
  const PotentialValue begun = begin_at_best_guess(is_first_stage);
  if (!std::isfinite(begun.energy)) {  // the pins' motion is barred, or the state is not finite
    NewtonOutcome outcome;
    if (potential_.has_self_contact() && !limit_guess_by_ccd()) outcome.end = NewtonEnd::blocked;
    return outcome;
  }
  const double beta_dt = static_ ? 1.0 : formula_.beta_dt;
  const NewtonOutcome outcome =
      newton_.minimise(end_, begun, body_.held.data(), body_.mass.data(), total_mass_, beta_dt);
  if (outcome.is_accepted()) solution_ = Solution{formula_, share, outcome.evaluated};
  return outcome;
}

template <class Real, class Device>
std::vector<Vec3<Real>> ImplicitStep<Real, Device>::pin_forces() const {
  std::vector<Vec3<Real>> force = downloaded(*body_.device, potential_.gradient(), body_.vertices);
  const std::vector<char> held = body_.held.download();
  for (int i = 0; i < body_.vertices; ++i)
    if (!held[i]) force[i].setZero();
  CompliantPins<Real> pins = body_.pins.compliant_pins();
  if (!pins.strength) return force;
  const std::vector<Vec3<Real>> target = downloaded(*body_.device, pins.target, body_.vertices);
  const std::vector<Real> strength = downloaded(*body_.device, pins.strength, body_.vertices);
  pins.target = target.data();
  pins.strength = strength.data();
  const std::vector<Vec3<Real>> x = body_.x.download();
  for (int i = 0; i < body_.vertices; ++i) force[i] += pins.force(i, x[i]);
  return force;
}

template <class Real, class Device>
Unbalanced ImplicitStep<Real, Device>::most_unbalanced() {
  potential_.evaluate(end_.data(), nullptr);  // the last trial of a line search may have been elsewhere
  const std::vector<Vec3<Real>> gradient = downloaded(*body_.device, potential_.gradient(), body_.vertices);
  const std::vector<char> held = body_.held.download();
  Unbalanced result;
  for (int i = 0; i < body_.vertices; ++i) {
    const double force = static_cast<double>(gradient[i].norm());
    if (held[i] || !(force > result.force)) continue;
    result.vertex = i;
    result.force = force;
  }
  if (result.vertex >= 0) result.position = end_.download()[result.vertex].template cast<double>();
  return result;
}

// Begins at the guess of the lowest potential. Last time's best guess is compared with its neighbours, and
// evaluated last, so that it need not be evaluated again.
template <class Real, class Device>
PotentialValue ImplicitStep<Real, Device>::begin_at_best_guess(bool is_first_stage) {
  if (!(last_h_ > 0)) return potential_of_guess(Guess::steady);
  Guess& favourite = favourite_[two_stage_ && !is_first_stage];
  if (favourite == Guess::extrapolated && !knows_trend_) favourite = Guess::accelerated;
  Guess best = Guess::accelerated;
  double lowest = std::numeric_limits<double>::infinity();
  const auto compare = [&](Guess rival) {
    const double energy = potential_of_guess(rival).energy;
    if (!(energy < lowest)) return;
    best = rival;
    lowest = energy;
  };
  if (favourite == Guess::accelerated) {
    compare(Guess::steady);
    if (knows_trend_) compare(Guess::extrapolated);
  } else {
    compare(Guess::accelerated);
  }
  const PotentialValue value = potential_of_guess(favourite);
  if (std::isfinite(value.energy) && value.energy <= lowest) return value;
  // Where the path to every guess with acceleration is barred, that of constant velocity may be free.
  favourite = std::isfinite(lowest) ? best : Guess::steady;
  return potential_of_guess(favourite);
}

template <class Real, class Device>
PotentialValue ImplicitStep<Real, Device>::potential_of_guess(Guess which) {
  guess(which);
  potential_.clip_to_obstacles(end_.data());
  const bool apart = !potential_.has_self_contact() || limit_guess_by_ccd();
  if (!apart || !potential_.path_is_clear(end_.data()))
    return {.energy = std::numeric_limits<double>::infinity()};
  potential_.update_friction_limits(end_.data());
  return potential_.evaluate(end_.data(), nullptr);
}

// Sets the positions and velocities from which the formula starts.
template <class Real, class Device>
void ImplicitStep<Real, Device>::predict() {
  const Real beta_dt = static_ ? Real(0) : static_cast<Real>(formula_.beta_dt);
  const Real extrapolation = static_cast<Real>(formula_.extrapolation),
             carried = static_cast<Real>(formula_.carried);
  const Vec3<Real>*x = body_.x.data(), *v = body_.v.data(), *x0 = x_before_.data(), *v0 = v_before_.data();
  const Vec3<Real>* a = acceleration_.data();
  Vec3<Real>*reference = reference_.data(), *drift = drift_.data(), *predicted = predicted_.data();
  for_each(
      *body_.device, {"implicit start", vectors(5 + (extrapolation > 0 ? 2 : 0) + (carried > 0 ? 1 : 0))},
      body_.vertices, HYST_KERNEL(int i) {
        reference[i] = x[i];
        drift[i] = v[i];
        if (extrapolation > 0) {
          reference[i] += extrapolation * (x[i] - x0[i]);
          drift[i] += extrapolation * (v[i] - v0[i]);
        }
        if (carried > 0) {
          reference[i] += carried * v[i];
          drift[i] += carried * a[i];
        }
        predicted[i] = reference[i] + beta_dt * drift[i];
      });
}

template <class Real, class Device>
void ImplicitStep<Real, Device>::guess(Guess which) {
  const Real h = static_cast<Real>(formula_.dt);
  // The weight of the acceleration in the guess [s^2]; for statics, which store a velocity in its place, [s].
  const double full_weight = static_ ? formula_.dt : formula_.beta_dt * formula_.beta_dt;
  const Real weight = which == Guess::steady ? Real(0) : static_cast<Real>(full_weight),
             trend = which == Guess::extrapolated ? static_cast<Real>(formula_.dt / last_h_) : Real(0);
  const Vec3<Real>*x = body_.x.data(), *v = body_.v.data(), *predicted = predicted_.data(),
        *a = acceleration_.data(), *before = acceleration_before_.data();
  const char* held = body_.held.data();
  Vec3<Real>* end = end_.data();
  for_each(
      *body_.device, {"implicit guess", vectors(2 + static_cast<int>(which))}, body_.vertices,
      HYST_KERNEL(int i) {
        if (held[i]) {
          end[i] = x[i] + h * v[i];
          return;
        }
        Vec3<Real> guessed = predicted[i];
        if (weight > 0) guessed += weight * a[i];
        if (trend > 0) guessed += weight * trend * (a[i] - before[i]);
        end[i] = guessed;
      });
}

// Shortens the guess until the cloth does not pass through itself on the path there; held vertices have to go
// all their way.  Returns whether such a guess was found.
template <class Real, class Device>
bool ImplicitStep<Real, Device>::limit_guess_by_ccd() {
  constexpr int kMaxShortenings = 12;
  constexpr double kWithin = 0.99, kFastest = 0.1;
  constexpr double kKeptShare = 0.4;  // a guess that presses layers further begins with huge forces
  double shorter = 1, whole = 1;
  potential_.begin_guess();
  for (int k = 0; k < kMaxShortenings; ++k) {
    shorten_guess(static_cast<Real>(shorter));
    whole *= shorter;
    potential_.aim_bodies(whole);
    const double feasible =
        potential_.collision_free_step(body_.x.data(), displacement_.data(), 1, kKeptShare);
    if (feasible >= 1) {
      potential_.take_bodies(1);
      potential_.accept_iterate(end_.data());
      return true;
    }
    shorter = std::max(kWithin * feasible, kFastest);
  }
  return false;
}

// Sets the displacement to the guess, that of free vertices (and of bodies) times `step_length`, and moves
// the guess there.
template <class Real, class Device>
void ImplicitStep<Real, Device>::shorten_guess(Real step_length) {
  const Vec3<Real>* x = body_.x.data();
  const char* held = body_.held.data();
  Vec3<Real>*end = end_.data(), *displacement = displacement_.data();
  for_each(
      *body_.device, {"implicit: displacement", vectors(4)}, body_.vertices, HYST_KERNEL(int i) {
        displacement[i] = held[i] ? Vec3<Real>(end[i] - x[i]) : Vec3<Real>(step_length * (end[i] - x[i]));
        end[i] = x[i] + displacement[i];
      });
}

// Both the formula's error and the extrapolation's are multiples of h^2 x^(2) (backward Euler: 1/2 against
// 1/2 more) or of h^3 x^(3) (bdf2 with w = h/h_before: (1 + w)^2/(6 w (1 + 2w)) against 1/6 + 1/(4w) more).
// tr-bdf2's is (sqrt 2 - 1)/2 - 1/6 of h^3 x^(3); its trapezoidal stage misses the extrapolation by gamma^3/4
// of that.
template <class Real, class Device>
double ImplicitStep<Real, Device>::local_error() {
  const StepFormula& formula = solution_.value().formula;
  const double w = last_h_ > 0 ? formula.dt / last_h_ : 1;
  const double of_bdf2 = (1 + w) * (1 + w) / (6 * w * (1 + 2 * w)), of_extrapolation = 1.0 / 6 + 1 / (4 * w);
  const double of_step = (std::sqrt(2.0) - 1) / 2 - 1.0 / 6, of_stage = std::pow(kTrapezoidalFraction, 3) / 4;
  const bool second = error_order() == 3;
  const double fraction = formula.carried > 0 ? of_step / of_stage
                          : second            ? of_bdf2 / (of_bdf2 + of_extrapolation)
                                              : 0.5;
  const Real h = static_cast<Real>(formula.dt), curved = second ? h * h / 2 : Real(0);
  const Vec3<Real>*x = body_.x.data(), *v = body_.v.data(), *a = acceleration_.data(), *end = end_.data();
  const char* held = body_.held.data();
  const Real* mass = body_.mass.data();
  double* size = size_.data();
  for_each_sum<1>(
      *body_.device, {"implicit error", vectors(second ? 4 : 3) + body_.mass.bytes()}, body_.vertices,
      HYST_KERNEL(int i, Sums<1>& sums) {
        if (held[i]) return;
        const Vec3<Real> miss = end[i] - x[i] - h * v[i] - curved * a[i];
        sums.term[0] += static_cast<double>(mass[i] * miss.squaredNorm());
      },
      HYST_KERNEL(const Sums<1>& total) { *size = total.term[0]; });
  return fraction * std::sqrt(size_.download()[0] / total_mass_);
}

// Histories and ledger see the way from the old state to the new one: commit_state() comes last.
template <class Real, class Device>
void ImplicitStep<Real, Device>::accept() {
  const Solution solution = solution_.value();
  solution_.reset();
  // The last trial of a line search may have been elsewhere.
  if (!solution.evaluated) potential_.evaluate(end_.data(), nullptr);
  if (!bending_lags_) body_.bending.accept();
  update_ledger(solution);
  body_.membrane.add_viscous_loss();
  body_.membrane.commit_friction(end_.data());
  commit_state(solution);
  knows_trend_ = last_h_ > 0;
  last_h_ = solution.formula.dt;
  knows_acceleration_ = true;
}

// Adds up the work of the forces over the way to the end of the step.  Membrane and contact have the rest of
// the gradient.
template <class Real, class Device>
void ImplicitStep<Real, Device>::update_ledger(const Solution& solution) {
  const Real rate = static_cast<Real>(1 / solution.formula.beta_dt);  // 0 in statics
  const Real inertia = rate * rate, drag = body_.drag() * rate;
  const Vec3<Real> g = body_.gravity(), carried = (1 - solution.fraction) * g;
  const GatheredForces<Real> bending = body_.bending.forces();
  const Vec3<Real>*x = body_.x.data(), *v = body_.v.data(), *end = end_.data(),
        *reference = reference_.data();
  const Vec3<Real>*predicted = predicted_.data(), *drift = drift_.data(), *gradient = potential_.gradient();
  const char* held = body_.held.data();
  const Real* mass = body_.mass.data();
  VertexLedger* ledger = body_.ledger.data();
  const Vec3<Real>* moved_pin = body_.pins.arcs();
  const CompliantPins<Real> compliant_pins = body_.pins.compliant_pins();
  const bool knows_forces = knows_forces_, along_arc = moved_pin && !knows_forces;
  knows_forces_ = forces_.size() > 0;
  VertexForces<Real>* kept = knows_forces_ ? forces_.data() : nullptr;
  const std::size_t bytes =
      body_.bending.force_bytes() + vectors(7) + total_bytes(body_.mass, body_.ledger, body_.ledger);
  for_each(
      *body_.device, {"implicit ledger", bytes}, body_.vertices, HYST_KERNEL(int i) {
        const Vec3<Real> d = end[i] - x[i], weight = mass[i] * g;
        const Vec3<Real> arc_displacement = held[i] && along_arc ? moved_pin[i] : d;
        const Vec3<Real> air = -mass[i] * drag * (end[i] - reference[i]);
        const Vec3<Real> inertial = mass[i] * inertia * (end[i] - predicted[i]);
        VertexForces<Real> now{bending.at(i), compliant_pins.force(i, end[i]) - mass[i] * carried, {}};
        now.remainder = inertial - air - weight - now.pins - now.bending - gradient[i];
        const VertexForces<Real> of = knows_forces ? now.mean(kept[i]) : now;
        if (kept) kept[i] = now;
        VertexLedger& sum = ledger[i];
        sum.bending_work += static_cast<double>(of.bending.dot(arc_displacement));
        sum.gravity_work += static_cast<double>(weight.dot(d));
        sum.implicit_work += static_cast<double>(of.remainder.dot(arc_displacement));
        sum.pin_work += static_cast<double>(of.pins.dot(d));
        if (held[i]) {
          sum.pin_work -= static_cast<double>((weight + of.pins).dot(d) +
                                              (of.bending + of.remainder).dot(arc_displacement));
          return;
        }
        // The unbalanced rest that Newton's method has left acts like one more force on the masses.
        sum.unbalanced -= static_cast<double>(gradient[i].dot(d));
        sum.air -= static_cast<double>(air.dot(d));
        // Statics begin with the velocities of the motion before them, which then drive nothing.
        const Vec3<Real> moved =
            rate > 0 ? Vec3<Real>(drift[i] + rate * (end[i] - predicted[i])) : Vec3<Real>(Vec3<Real>::Zero());
        sum.inertia += static_cast<double>((inertial + of.sum() - now.sum()).dot(d) -
                                           mass[i] / 2 * (moved.squaredNorm() - v[i].squaredNorm()));
      });
}

template <class Real, class Device>
void ImplicitStep<Real, Device>::commit_state(const Solution& solution) {
  const Real rate = static_cast<Real>(1 / solution.formula.beta_dt),
             h = static_cast<Real>(solution.formula.dt);
  const bool two_step = two_step_, statics = static_, at_end = two_stage_;
  Vec3<Real>*x = body_.x.data(), *v = body_.v.data(), *x0 = x_before_.data(), *v0 = v_before_.data();
  const Vec3<Real>*end = end_.data(), *reference = reference_.data(), *drift = drift_.data();
  Vec3<Real>*acceleration = acceleration_.data(), *acceleration_before = acceleration_before_.data();
  const char* held = body_.held.data();
  for_each(
      *body_.device, {"implicit end", vectors(two_step ? 10 : 8)}, body_.vertices, HYST_KERNEL(int i) {
        const Vec3<Real> moved = held[i] ? v[i] : Vec3<Real>(rate * (end[i] - reference[i]));
        if (two_step) {
          x0[i] = x[i];
          v0[i] = v[i];
        }
        acceleration_before[i] = acceleration[i];
        acceleration[i] = statics ? Vec3<Real>((end[i] - x[i]) / h) : Vec3<Real>((moved - v[i]) / h);
        if (at_end && !held[i]) acceleration[i] = rate * (moved - drift[i]);
        x[i] = end[i];
        v[i] = moved;
      });
}

template class ImplicitStep<double, ThisDevice>;
template class ImplicitStep<float, ThisDevice>;

}  // namespace hysteron
