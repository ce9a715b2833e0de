// Newton's method with line search on the incremental potential.
#pragma once

#include "sim/device/host_result.h"
#include "sim/linear/linear_solver.h"
#include "sim/time/convergence.h"
#include "sim/time/incremental_potential.h"

namespace hysteron {

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

 private:
  // A step along the direction and the potential after it; of length 0: no step is feasible.
  struct Trial {
    double length = 0;
    PotentialValue value = {};
  };
  Trial first_try(const Vec3<Real>* x, double farthest, double total_mass);
  Trial try_step(const Vec3<Real>* x, double step_length);
  double search(Buffer<Vec3<Real>, Device>& x, PotentialValue& value, Trial first, double slope,
                double blurred);

  Device& device_;
  int vertices_;
  IncrementalPotential<Real, Device>& potential_;
  LinearSolver<Real, Device>& solver_;
  NewtonLimits limits_;
  Buffer<Vec3<Real>, Device> direction_, trial_;
  HostResult<CorrectionSums, Device> correction_;
};

}  // namespace hysteron
