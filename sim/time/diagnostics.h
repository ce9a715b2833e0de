// What a simulation tells of itself: its steps, its work, its memory.
#pragma once

#include <cstddef>
#include <string>

#include "sim/device/device_counts.h"

namespace hysteron {

struct StepLimits {
  double bending_step =
      0;  // largest stable explicit bending step, safety margin included; 0 where no step is too long [s]
  double membrane_step = 0;  // the same for the membrane; 0 if the integrator treats it implicitly [s]
  int substeps = 1;          // alpha in use
  double substep = 0;        // he = hi/alpha [s]
};

// Counts since the start, which steps keep anyway.
struct Diagnostics {
  long steps = 0;
  long parts = 0;   // into which steps were divided, by retries or a tolerance
  long stages = 0;  // accepted in motion: one a part, two of tr-bdf2
  // Steps that were taken again in smaller parts, or at the smallest with more of contact's stiffness.
  long retried = 0;
  long unbalanced = 0;  // parts taken before Newton's method had converged
  // Parts taken with a vertex in a solid, driven there by a blow or left there by a step that was taken
  // unbalanced; and those with one that something presses into a solid from its other side.
  long deep = 0, pinched = 0;
  double pinch_depth = 0;  // the deepest of the latter below a surface [m]
  // Of hands of limited strength, and of rigid ones that gave way to the cloth: parts of steps in which one
  // pulled with all that it may, in which rigid ones gave way, and how far vertices have lagged behind at
  // most [m].
  long saturated_pins = 0, blocked_pins = 0;
  double pin_lag = 0;
  long newton = 0, linear = 0;  // iterations of all implicit solves
  double time_steps = 0;        // sum over Newton's iterations, 1 for a full step
  // What Newton's method has left at the ends of stages: the largest unbalanced force over load, and the
  // velocity that it would give free masses within the stage, the largest and the sum, each a root mean
  // square over the cloth [m/s].
  double largest_residual = 0, largest_velocity = 0, velocities = 0;
  DeviceCounts device;    // launches, waits and allocations of all steps
  std::size_t bytes = 0;  // on the device

  double per_step(long count) const {
    return steps ? static_cast<double>(count) / static_cast<double>(steps) : 0;
  }
  double mean_velocity() const { return stages > 0 ? velocities / static_cast<double>(stages) : 0; }
};

// A part of a scene and what it costs; parts that the scene does not need have no bytes and say why.
struct ScenePart {
  std::string name;
  bool included = false;
  std::size_t bytes = 0;
  std::string kernels;  // names of its loops
  std::string reason;
};

}  // namespace hysteron
