// The heavy elastica with a bending law: the reference for cloth that hangs from a clamp.  A planar curve,
// its equilibrium of moments solved at points of its own; nothing of the cloth's solver.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/bending/laws/law_run.h"

namespace hysteron {

// A strip clamped level at one end.
struct HeavyStrip {
  LawRequest law;
  double rigidity = 1;  // q, that of the strip's direction over the law's: M = sqrt(q) M_law(sqrt(q) K)
  double weight = 1;    // per area, of load 1 [N/m^2]
  double tilt = 0;      // of the load: from straight down towards the free end [rad]
  double length = 1;    // [m]
  int segments = 200;   // shorter towards the clamp
};

// In equilibrium under `load` times the weight.
struct SaggingStrip {
  double load = 0;
  std::vector<double> arc;  // distance from the clamp of the segments' ends: segments + 1 values [m]
  std::vector<Eigen::Vector2d> line;               // their places: forward, down [m]
  std::vector<double> angle;                       // their slopes, downward positive [rad]
  std::vector<double> curvature;                   // of each segment at its middle [1/m]
  double drop() const { return line.back().y(); }  // of the free end [m]
  double chord_angle() const;                      // of the free end, seen from the clamp [rad]
};

// The strip's equilibria under `loads`, one after the other, from rest: the law's history is accepted at each
// load and on the way there (steps of at most 1/steps of the largest load; continuation, halved where
// Newton's method fails).  Second order in the segments' lengths.  Laws with a clock take 1 s for each step.
// Error::simulation if no equilibrium is found, or none within a bounded number of steps.
std::vector<SaggingStrip> sagging_strips(const HeavyStrip& strip, const std::vector<double>& loads,
                                         int steps = 50);

}  // namespace hysteron
