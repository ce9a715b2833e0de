// The formula by which an implicit step forms velocities from positions.
#pragma once

#include <cmath>
#include <limits>

namespace hysteron {

// v = (x - reference)/beta_dt with reference = (1 + e) x_n - e x_{n-1} + c v_n, e the extrapolation;
// accelerations are formed from velocities likewise.
struct StepFormula {
  double dt = 0;             // from x_n to x [s]
  double beta_dt = 0;        // the formula's coefficient beta times dt [s]; infinite in statics
  double extrapolation = 0;  // 0 in one-step formulas
  double carried = 0;        // c [s]; not 0 in the trapezoidal rule alone

  static StepFormula backward_euler(double dt) { return {dt, dt, 0}; }
  // An equilibrium has no inertia, drag or viscosity.
  static StepFormula statics(double dt) { return {dt, std::numeric_limits<double>::infinity(), 0}; }
  bool is_static() const { return std::isinf(beta_dt); }
  static StepFormula trapezoidal(double dt) { return {dt, dt / 2, 0, dt / 2}; }
  // Two-step backward differences on unequal steps have the ratio w = dt/before (Hairer, Norsett & Wanner
  // 1993, III.5).
  static StepFormula bdf2(double dt, double before) {
    const double w = dt / before;
    return {dt, dt * (1 + w) / (1 + 2 * w), w * w / (1 + 2 * w)};
  }
};

}  // namespace hysteron
