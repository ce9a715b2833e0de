// The largest stable substep of explicit bending, measured, beside the bound that the program uses.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/bending/choices.h"

namespace hysteron::experiments {

// How the waves are.
struct LimitCondition {
  std::string name;  // in the plot
  std::string law = "linear";
  double damping = 0;  // fabric.damping [s]
  // Of the shakings that must all stay bounded [m].  Waves of 1e-9 m are linear.  Larger ones couple with the
  // membrane and can gain energy at isolated steps far below the linear limit, as if they resonated with the
  // steps (Schlick, Mandziuk, Skeel & Srinivas 1998, J. Comput. Phys. 140:1): without damping one mode then
  // grows to some ten times the energy of all and stays there, which no smaller bound excludes.
  std::vector<double> amplitudes = {1e-9};
  bool resonates() const { return amplitudes.size() > 1; }
};

// A square of 0.2 m and 128 triangles without gravity, whose vertices are shaken out of its plane.
struct LimitCase {
  std::string mesh = "random";  // family
  BendingElement element = BendingElement::shape;
  bool held = false;  // by its left edge
  LimitCondition condition = {};
};

struct MeasuredLimit {
  LimitCase of;
  double bound = 0;     // that the program keeps [s]
  double measured = 0;  // largest step up to which the energy of all that were tried stays bounded [s]
  double ratio() const { return measured / bound; }
};

// Whether the energy of `substeps` steps of `step` [s] stays below 100 times the initial one and is at most
// twice as large in their second half as in the first.
bool is_bounded(const LimitCase& of, double step, int substeps);

// Tries steps from kMinRatio of the bound upwards (by 8 % where waves may resonate), then halves between
// the last bounded one and the next one, to 1 %.  A limit below kMinRatio is given as 0, one above
// kMaxRatio as that.
inline constexpr double kMinRatio = 0.3, kMaxRatio = 3;
MeasuredLimit measure_limit(const LimitCase& of, int substeps);

// All mesh families and both elements, condition by condition, the first two of these also held; only the
// first, free, for `quick`.
std::vector<LimitCase> limit_cases(bool quick);

// `threads` at a time; in the order of the cases.
std::vector<MeasuredLimit> measure_limits(const std::vector<LimitCase>& cases, int substeps, int threads);

}  // namespace hysteron::experiments
