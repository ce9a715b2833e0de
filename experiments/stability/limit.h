// The largest stable substep of explicit bending, measured, beside the bound that the program uses.
#pragma once

#include <string>
#include <vector>

#include "sim/bending/choices.h"

namespace hysteron::experiments {

inline constexpr double kLinearWave = 1e-9;  // largest amplitude that couples with nothing [m]

// A square of 0.2 m and 128 triangles without gravity, whose vertices are shaken out of its plane.
struct LimitCase {
  std::string mesh = "random";  // family
  BendingElement element = BendingElement::shape;
  bool held = false;  // by its left edge
  std::string law = "linear";
  double damping = 0;  // fabric.damping [s]
  // Of the shaking that must stay bounded, beside that of a linear wave [m].  Larger waves couple with the
  // membrane and can gain energy at isolated steps far below the linear limit, as if they resonated with the
  // steps (Schlick, Mandziuk, Skeel & Srinivas 1998, J. Comput. Phys. 140:1): without damping one mode then
  // grows to some ten times the energy of all and stays there, which no smaller bound excludes.
  double amplitude = kLinearWave;
  bool resonates() const { return amplitude > kLinearWave; }
};

struct MeasuredLimit {
  LimitCase of;
  double bound = 0;     // that the program keeps [s]
  double measured = 0;  // largest step up to which the energy of all that were tried stays bounded [s]
  double ratio() const { return measured / bound; }
};

// Tries steps of so many substeps from kMinRatio of the bound upwards (by 8 % where waves may resonate), then
// halves between the last bounded one and the next one, to 1 %.  A limit below kMinRatio is given as 0, one
// above kMaxRatio as that.
inline constexpr double kMinRatio = 0.3, kMaxRatio = 3;
MeasuredLimit measure_limit(const LimitCase& of, int substeps);

// All mesh families and both elements, law by law and amplitude by amplitude, some of them also held; only
// the first, free, for `quick`.
std::vector<LimitCase> limit_cases(bool quick);

}  // namespace hysteron::experiments
