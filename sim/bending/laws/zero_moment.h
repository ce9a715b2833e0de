// Finds the curvature at which a law carries no moment: the minimum of its incremental potential.
//
// From a given state W(K) = stored + dissipated is convex with dW/dK = M, so that damped Newton on W finds
// the one curvature where a piece of cloth at rest would stay (the residual curvature, Anandjiwala & Leaf
// 1991). Laws with a closed form use that instead.
#pragma once

#include <cmath>

#include "sim/bending/laws/law.h"

namespace hysteron {

// Solves A x = b for symmetric positive definite A by elimination; runs on both devices.
template <class Real, int D>
HYST_HD Vec<Real, D> solve_definite(Tangent<Real, D> a, Vec<Real, D> b) {
  for (int i = 0; i < D; ++i) {
    for (int j = i + 1; j < D; ++j) {
      const Real factor = a(j, i) / a(i, i);
      for (int k = i; k < D; ++k) a(j, k) -= factor * a(i, k);
      b[j] -= factor * b[i];
    }
  }
  for (int i = D - 1; i >= 0; --i) {
    for (int k = i + 1; k < D; ++k) b[i] -= a(i, k) * b[k];
    b[i] /= a(i, i);
  }
  return b;
}

// Returns the curvature [1/m] of zero moment, reached from the state `history`; the search begins at `start`.
// It ends when a Newton step is below 1e-12 (double) or 1e-5 (float) of the curvature, or after 60 steps.
template <class Law, class Real, int D, int N>
HYST_HD Vec<Real, D> zero_moment(const Law& law, const History<Real, N>& history, Vec<Real, D> start) {
  using std::abs;
  constexpr int kMaxSteps = 60, kMaxHalvings = 30;
  constexpr Real kPrecision = sizeof(Real) == 8 ? Real(1e-12) : Real(1e-5);
  constexpr Real kEnoughDescent = Real(1e-4);                 // Armijo's fraction of the predicted decrease
  const Real softest = law.largest_stiffness() * kPrecision;  // keeps the tangent invertible where b2 = 0
  Vec<Real, D> curvature = start, newton = Vec<Real, D>::Zero();
  Real fraction = 1, energy = 0, descent = 0;
  Real half_moment = 0;  // decides where energies differ only by rounding, so that steps cannot go to and fro
  for (int step = 0, halving = kMaxHalvings; step <= kMaxSteps;) {
    const Vec<Real, D> tried = curvature + fraction * newton;
    const LawStep<Real, D, N> here = called_step(law, tried, history);
    const Real reached = here.stored + here.dissipated;
    const bool enough = reached <= energy + fraction * descent ||
                        (reached <= energy + kPrecision * abs(energy) && here.moment.norm() <= half_moment);
    if (!enough && ++halving < kMaxHalvings) {
      fraction /= 2;
      continue;
    }
    curvature = tried;
    const Tangent<Real, D> tangent =
        called_tangent(law, curvature, history) + softest * Tangent<Real, D>::Identity();
    newton = -solve_definite<Real, D>(tangent, here.moment);
    if (!(newton.norm() > kPrecision * curvature.norm())) break;
    energy = reached, descent = kEnoughDescent * here.moment.dot(newton);
    half_moment = here.moment.norm() / 2;
    fraction = 1, halving = 0;
    ++step;
  }
  return curvature;
}

}  // namespace hysteron
