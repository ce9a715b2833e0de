// Poses a step of a law as a minimum problem: the incremental potential W(K) = int M dK at a fixed history,
// and a tangent that stays positive semidefinite.
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

template <class Law>
struct StepAndPotential {
  LawStep<typename Law::Scalar, Law::kDimension, Law::kHistory> step;
  typename Law::Scalar potential;  // step_potential()
};
template <class Law>
concept LawWithTriedStep = requires(const Law& law, const CurvatureOf<Law>& k, const HistoryOf<Law>& h) {
  { law.step_and_potential(k, h) } -> std::same_as<StepAndPotential<Law>>;
};

// Returns W up to a constant of the history [J/m^2].  Where all loss happens on the way to K, it is the
// energy stored plus that lost; laws that creep or weaken at the end of their step compute it themselves.
template <class Law, class Real, int D, int N>
HYST_HD Real step_potential(const Law& law, const Vec<Real, D>& curvature, const History<Real, N>& before) {
  if constexpr (LawWithPotential<Law>) {
    return law.potential(curvature, before);
  } else if constexpr (LawWithTriedStep<Law>) {
    return law.step_and_potential(curvature, before).potential;
  } else {
    const LawStep<Real, D, N> step = law.step(curvature, before);
    return step.stored + step.dissipated;
  }
}

// Computes a step and its potential at once: laws around other laws evaluate them once for both.
template <class Law>
HYST_HD StepAndPotential<Law> step_and_potential(const Law& law, const CurvatureOf<Law>& curvature,
                                                 const HistoryOf<Law>& before) {
  if constexpr (LawWithTriedStep<Law>) {
    return law.step_and_potential(curvature, before);
  } else {
    const auto step = law.step(curvature, before);
    if constexpr (LawWithPotential<Law>)
      return {step, law.potential(curvature, before)};
    else
      return {step, step.stored + step.dissipated};
  }
}

// Returns dM/dK without its negative part, which a law has where its moment falls.
template <class Law, class Real, int D, int N>
HYST_HD Tangent<Real, D> convex_tangent(const Law& law, const Vec<Real, D>& curvature,
                                        const History<Real, N>& before) {
  if constexpr (LawWithConvexTangent<Law>)
    return law.convex_tangent(curvature, before);
  else
    return law.tangent(curvature, before);
}

}  // namespace hysteron
