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
  return even_stops(c.curve.b1 - c.curve.b2, c.curve.k0, c.stack ? kMostStops : c.stops);
}

// The law for few stops or for the most.
constexpr int kFewStops = 8;
inline int room_for_stops(const LawChoice& c) {
  return measured_stops(c).size() <= kFewStops ? kFewStops : kMostStops;
}

// visit(law) with these branches around the stops, none of them if there are none.
template <class Stops, class Visit>
void visit_relaxing(const Stops& stops, const RelaxingBranches& branches, const Visit& visit) {
  if (branches.empty())
    visit(stops);
  else
    visit(Relaxing<Stops, kMostBranches>::make(stops, branches));
}

// The same with room for N stops, setting if the fabric does.
template <class Real, int D, int N, class Visit>
void visit_measured(const LawChoice& c, const RelaxingBranches& branches, const Visit& visit) {
  const Spectrum warp = measured_stops(c);
  const BendingParts& parts = c.curve.parts;
  const auto stops = SpectrumStops<Real, D, N>::make(c.curve.b2, warp, parts.weft_stops);
  visit_relaxing(stops, branches, [&]<class Law>(const Law& law) {
    if (parts.set.on())
      visit(Setting<Law>::make(law, c.curve.b2, parts.set));
    else
      visit(law);
  });
}

}  // namespace hysteron
