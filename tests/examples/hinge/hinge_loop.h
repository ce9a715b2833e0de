// These hinges of a program of one's own bend by the law `prandtl`.
#pragma once

#include <vector>

#include "sim/bending/laws/prandtl_stops.h"

using Law = hysteron::PrandtlStops<double, 1, 8>;  // 8 friction elements

struct Hinge {
  double length;                       // of the edge [m]
  double height;                       // by which its angle is divided for the curvature [m]
  double rest_angle = 0;               // [rad]
  double torque = 0;                   // [N m]
  hysteron::HistoryOf<Law> history{};  // what it remembers of how it was bent; at first nothing
};

// Torques at these angles [rad], which are accepted; returns the energy lost to friction on the way [J].
inline double bend(const Law& law, std::vector<Hinge>& hinges, const std::vector<double>& angles) {
  double lost = 0;
  for (std::size_t i = 0; i < hinges.size(); ++i) {
    Hinge& hinge = hinges[i];
    const hysteron::CurvatureOf<Law> curvature((angles[i] - hinge.rest_angle) / hinge.height);
    const auto step = law.step(curvature, hinge.history);
    hinge.torque = step.moment[0] * hinge.length;
    hinge.history = step.history;
    lost += step.dissipated * hinge.length * hinge.height;
  }
  return lost;
}
