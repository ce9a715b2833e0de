// Acts on a law from outside: sets the time of its steps, edits its rest curvature, irons it.
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

// Tells a law that creeps or ages how long the coming step takes [s]; other laws ignore it.
template <class Law, class Real>
HYST_HD void set_step_time(Law& law, Real seconds) {
  if constexpr (TimedLaw<Law>)
    law.dt = seconds;
  else if constexpr (requires { law.law; })
    set_step_time(law.law, seconds);
}

// Returns the history after making this curvature the rest curvature; unchanged for laws that cannot be
// edited.
template <class Law, class Real, int D, int N>
HYST_HD History<Real, N> edited(const Law& law, const Vec<Real, D>& curvature,
                                const History<Real, N>& before) {
  if constexpr (EditableLaw<Law>)
    return law.edited(curvature, before);
  else
    return before;
}

// Returns the history after ironing at this curvature: as if virgin cloth had been bent there in one step, at
// once.  A law with ironed() decides itself which part of its history remains.
template <class Law, class Real, int D, int N>
HYST_HD History<Real, N> ironed(Law law, const Vec<Real, D>& curvature, const History<Real, N>& before) {
  set_step_time(law, Real(0));
  History<Real, N> fresh;
  if constexpr (LawWithIroning<Law>) fresh = law.ironed(before);
  return called_step(law, curvature, fresh).history;
}

// Returns how far friction or plasticity is used, 0 to 1: the law's own measure, else |M - b2 K|/M0.
template <class Law, class Real, int D, int N>
HYST_HD Real friction_utilisation(const Law& law, const Vec<Real, D>& curvature,
                                  const History<Real, N>& memory, Real b2, Real m0) {
  if constexpr (LawWithUse<Law>)
    return law.utilisation(curvature, memory);
  else if (N > 0 && m0 > 0)
    return (called_step(law, curvature, memory).moment - b2 * curvature).norm() / m0;
  return 0;
}

}  // namespace hysteron
