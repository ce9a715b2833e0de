// Newton's method with line search on the incremental potential.
#pragma once

#include "sim/device/host_result.h"
#include "sim/linear/linear_solver.h"
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

struct NewtonOutcome {
  bool converged = false;   // or accepted unconverged
  bool unbalanced = false;  // accepted unconverged
  bool blocked = false;     // the pins' own motion leads the cloth through itself
  bool evaluated = true;    // the potential was last evaluated at the result
  int iterations = 0;
  long linear_iterations = 0;
  double time_steps = 0;  // sum of step lengths, 1 for a full step
  double residual = 0;    // norm of the unbalanced force [N]
  double load = 0;        // weight and reactions, or inertia if that is larger [N]
  double velocity = 0;    // root mean square that the residual gives free masses in the step [m/s]
};

template <class Real, class Device>
class Newton {
 public:
  Newton(Device& device, int vertices, IncrementalPotential<Real, Device>& potential,
         LinearSolver<Real, Device>& solver, const NewtonLimits& limits);

  // Minimises the potential over the vertices that are not held, from x on (n vertices [m]), where it was
  // evaluated last as `value`. held: n flags; mass: n masses [kg], with their sum; `beta_dt` turns
  // corrections into velocities [s].  Each accepted iterate lowers the potential, up to rounding.
  NewtonOutcome minimise(Buffer<Vec3<Real>, Device>& x, PotentialValue value, const char* held,
                         const Real* mass, double total_mass, double beta_dt);
  void set_limits(const NewtonLimits& limits) { limits_ = limits; }
  std::size_t bytes() const { return total_bytes(direction_, trial_); }

  // The parts of minimise(); public because nvcc allows no device lambda in a private member function.
  struct Correction {
    double size2;    // sum of m |d|^2 [kg m^2]
    double slope;    // gradient . d [J]
    double extent2;  // sum of m |x|^2 [kg m^2]
    // Sum of (trace of the stiffness times |x|)^2, whose rounding no force escapes, for free cloth [N^2].
    double forces2;
  };
  void measure_correction(const LinearSystem<Real, Device>& system, const Vec3<Real>* x, const Real* mass,
                          const char* held, bool with_forces);
  void place_trial(const Vec3<Real>* x, Real step_length);

 private:
  // A step along the direction and the potential after it; of length 0: no step is feasible.
  struct Trial {
    double length = 0;
    PotentialValue value = {};
  };
  Trial first_try(const Vec3<Real>* x, double farthest, double total_mass);
  Trial try_step(const Vec3<Real>* x, double step_length) {
    place_trial(x, static_cast<Real>(step_length));
    potential_.take_bodies(step_length);
    return {step_length, potential_.evaluate(trial_.data(), direction_.data())};
  }
  double search(Buffer<Vec3<Real>, Device>& x, PotentialValue& value, Trial first, double slope,
                double blurred);

  Device& device_;
  int vertices_;
  IncrementalPotential<Real, Device>& potential_;
  LinearSolver<Real, Device>& solver_;
  NewtonLimits limits_;
  Buffer<Vec3<Real>, Device> direction_, trial_;
  HostResult<Correction, Device> correction_;
};

}  // namespace hysteron
