// Newton's method with line search on the incremental potential.
#pragma once

#include "sim/device/host_result.h"
#include "sim/linear/linear_solver.h"
#include "sim/time/incremental_potential.h"

namespace hysteron {

// A step has converged when the unbalanced force is small or the last correction was.
struct NewtonLimits {
  // Norm of the unbalanced force over that of the weight and what the handles carry, or, where the masses'
  // inertia is larger, over that: free cloth without weight has nothing else to compare with.
  double residual = 1e-6;
  double velocity = 1e-9;  // root mean square of a correction over the step's time, or of those that would
                           // follow, or of what the unbalanced force makes of free masses in it [m/s]
  int iterations = 60;
  bool take_unconverged = false;  // what is reached by then is taken as it is
  // Statics: the masses times a shift are added to the stiffness, which may be singular on the way; the shift
  // falls with every full step and rises with every shortened one [1/s^2].
  double first_shift = 0, least_shift = 0;
  SolverTuning tuning = {};
};

struct NewtonOutcome {
  bool converged = false;   // or taken as it is
  bool unbalanced = false;  // taken as it is
  bool blocked = false;     // the handles' own motion leads the cloth through itself
  bool evaluated = true;    // the potential was last evaluated where the search has ended
  int iterations = 0;
  long linear_iterations = 0;
  double time_steps = 0;  // sum over the iterations, 1 for a full step
  double residual = 0;    // [N]
  double load = 0;        // weight and reactions, or inertia if that is larger [N]
  double velocity = 0;    // what the residual makes of free masses in the step, root mean square [m/s]
};

template <class Real, class Device>
class Newton {
 public:
  Newton(Device& device, int vertices, IncrementalPotential<Real, Device>& potential,
         LinearSolver<Real, Device>& solver, const NewtonLimits& limits);

  // Minimises the potential over the vertices that are not held, from x on, where it was evaluated last as
  // `value`.  `beta_dt` turns corrections into velocities [s].  Each accepted iterate lowers the potential,
  // up to rounding.
  NewtonOutcome minimise(Buffer<Vec3<Real>, Device>& x, PotentialValue value, const char* held,
                         const Real* mass, double total_mass, double beta_dt);
  void set_limits(const NewtonLimits& limits) { limits_ = limits; }
  std::size_t bytes() const { return total_bytes(direction_, trial_); }

  // The parts of minimise(); public because nvcc allows no device lambda in a private member function.
  struct Correction {
    double size2;    // sum of m |d|^2 [kg m^2]
    double slope;    // gradient . d [J]
    double extent2;  // sum of m |x|^2 [kg m^2]
    double forces2;  // sum of (trace of the stiffness times |x|)^2, whose rounding no force escapes; of free
                     // cloth [N^2]
  };
  void measure_correction(const LinearSystem<Real, Device>& system, const Vec3<Real>* x, const Real* mass,
                          const char* held, bool with_forces);
  void place_trial(const Vec3<Real>* x, Real step_length);

 private:
  // A step along the direction and the potential after it; of length 0: none that is feasible.
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
