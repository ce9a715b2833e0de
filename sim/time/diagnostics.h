// Counts and measures that a simulation reports: its steps, its work, its memory.
#pragma once

#include <cstddef>
#include <string>

#include "sim/device/device_counts.h"

namespace hysteron {

struct StepLimits {
  double bending_step = 0;   // largest stable explicit bending step with its margin; 0: no bound [s]
  double membrane_step = 0;  // the same for the membrane; 0 if it is implicit [s]
  int substeps = 1;          // alpha, the number in use
  double substep = 0;        // he = hi/alpha [s]
};

// Counts since the start, which steps keep in any case.
struct Diagnostics {
  long steps = 0;
  long parts = 0;   // into which retries or a tolerance divided steps
  long stages = 0;  // accepted in motion: one per part, two for tr-bdf2
  // Counts steps that were taken again in smaller parts, or, at the smallest, with more of contact's
  // stiffness.
  long retried = 0;
  long unbalanced = 0;  // parts taken before Newton's method had converged
  // `deep` counts parts taken with a vertex in a solid, driven there by a blow or left there by an unbalanced
  // step; `pinched` those with a vertex that something presses into a solid from its other side.
  long deep = 0, pinched = 0;
  double pinch_depth = 0;  // the deepest pinched vertex below a surface [m]
  // Pins of limited strength, and rigid ones that gave way to the cloth: parts of steps in which a pin pulled
  // with its whole strength, parts in which rigid ones gave way, and the farthest that vertices have lagged
  // behind [m].
  long saturated_pins = 0, blocked_pins = 0;
  double pin_lag = 0;
  long newton = 0, linear = 0;  // iterations of all implicit solves
  double time_steps = 0;        // sum over Newton's iterations, 1 for a full step
  // These say what Newton's method left at the ends of stages: the largest unbalanced force over load; and
  // the velocity that it would give free masses within the stage, the largest and the sum, each a root mean
  // square over the cloth [m/s].
  double largest_residual = 0, largest_velocity = 0, velocities = 0;
  DeviceCounts device;    // launches, waits and allocations of all steps
  std::size_t bytes = 0;  // on the device

  double per_step(long count) const {
    return steps ? static_cast<double>(count) / static_cast<double>(steps) : 0;
  }
  double mean_velocity() const { return stages > 0 ? velocities / static_cast<double>(stages) : 0; }
};

// A part of a scene and its memory; parts that the scene does not need have no bytes and say why.
struct ScenePart {
  std::string name;
  bool included = false;
  std::size_t bytes = 0;
  std::string kernels;  // the names of its loops
  std::string reason;
};

}  // namespace hysteron
