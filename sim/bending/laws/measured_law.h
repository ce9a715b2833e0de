// From what a fabric has beyond three numbers to a law as a type: stops, relaxing branches beside them, both
// behind a rest curvature that sets.
//
// A part that the fabric does not have is not in the type, so that it takes neither history nor time.  The
// number of stops has two capacities: each is a type of its own and takes its time to compile.
#pragma once

#include "sim/bending/laws/relaxing.h"
#include "sim/bending/laws/setting.h"
#include "sim/bending/laws/spectrum_stops.h"

namespace hysteron {

// The fabric's stops along warp, or those that b1, b2 and k0 make (prandtl_stops.h): as many as the law is to
// have, the most where it would remember by a stack.
inline Spectrum measured_stops(const LawChoice& c) {
  if (!c.curve.parts.stops.empty()) return c.curve.parts.stops;
  Spectrum even;
  const int count = c.stack ? kMostStops : c.stops;
  if (c.curve.k0 > 0)
    for (int j = 0; j < count; ++j) {
      even.thresholds.push_back((j + 0.5) * c.curve.k0 / count);
      even.stiffnesses.push_back((c.curve.b1 - c.curve.b2) / count);
    }
  return even;
}

// visit(law), setting if the fabric does.
template <class Law, class Visit>
void visit_setting(const LawChoice& c, const Law& law, const Visit& visit) {
  if (c.curve.parts.set.on())
    visit(Setting<Law>::make(law, c.curve.b2, c.curve.parts.set));
  else
    visit(law);
}

template <class Law, class Visit>
void visit_relaxing(const LawChoice& c, const Law& law, const RelaxingBranches& branches,
                    const Visit& visit) {
  if (branches.empty())
    visit_setting(c, law, visit);
  else
    visit_setting(c, Relaxing<Law, kMostBranches>::make(law, branches), visit);
}

// visit(law) with these branches, none of them if there are none.
template <class Real, int D, class Visit>
void visit_measured(const LawChoice& c, const RelaxingBranches& branches, const Visit& visit) {
  constexpr int kFew = 8;
  const Spectrum warp = measured_stops(c);
  const Spectrum& weft = c.curve.parts.weft_stops;
  if (warp.size() <= kFew)
    visit_relaxing(c, SpectrumStops<Real, D, kFew>::make(c.curve.b2, warp, weft), branches, visit);
  else
    visit_relaxing(c, SpectrumStops<Real, D, kMostStops>::make(c.curve.b2, warp, weft), branches, visit);
}

}  // namespace hysteron
