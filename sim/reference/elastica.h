// Solves the heavy elastica with a bending law, the reference for cloth that hangs from a clamp: a planar
// curve, whose equilibrium of moments is solved at points of its own; it uses nothing of the cloth's solver.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/bending/laws/law_run.h"

namespace hysteron {

// A strip clamped level at one end.
struct HeavyStrip {
  LawRequest law;
  double rigidity = 1;  // q, rigidity of the strip's direction over the law's: M = sqrt(q) M_law(sqrt(q) K)
  double weight = 1;    // per area, for load 1 [N/m^2]
  double tilt = 0;      // angle of the load from straight down towards the free end [rad]
  double length = 1;    // [m]
  int segments = 200;   // number of segments, which are shorter towards the clamp
};

// A strip in equilibrium under `load` times the weight.
struct SaggingStrip {
  double load = 0;
  std::vector<double> arc;  // distance from the clamp of the segments' ends: segments + 1 values [m]
  std::vector<Eigen::Vector2d> line;               // their positions: forward, down [m]
  std::vector<double> angle;                       // their slopes, downward positive [rad]
  std::vector<double> curvature;                   // curvature of each segment at its middle [1/m]
  double drop() const { return line.back().y(); }  // drop of the free end [m]
  double chord_angle() const;                      // direction of the free end from the clamp [rad]
};

// Returns the strip's equilibria under `loads`, one after the other, from rest: the law's history is accepted
// at each load and on the way there (steps of at most 1/steps of the largest load; continuation, halved where
// Newton's method fails).  Errors are of second order in the segments' lengths.  Laws with a clock take 1 s
// for each step.  Throws Error::simulation if no equilibrium is found, or none within a bounded number of
// steps.
std::vector<SaggingStrip> sagging_strips(const HeavyStrip& strip, const std::vector<double>& loads,
                                         int steps = 50);

}  // namespace hysteron
