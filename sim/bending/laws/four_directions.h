// Runs a scalar law on the curvature tensor: four copies act along fixed material directions.
//
//   K_d = w_d . S,   M = omega/4 sum_d M_d w_d,   w_d = s (nu(n_d) + beta nu(t_d))
//   nu(n) = (n_x^2, n_y^2, sqrt2 n_x n_y),   n_d at 22.5 + 45 d degrees, t_d across it
//
// beta = -(sqrt2 - 1)^2 = -tan^2(22.5 deg) makes a bend along x or y excite two directions and leave the
// other two at exactly zero, and makes omega/4 sum w_d w_d^T = omega s^2 (1 - beta)^2/4 I, 0.9995 I here.
// s and omega are chosen here so that bends along x, y and both diagonals follow the scalar law within 0.4 %.
// In between friction is overrated: fully slipping it is omega s/2 = 1.21 M0 along a direction n_d.  That
// ratio to its value along x, (1 + sqrt2)/2, is the same for any s and omega; it costs at most 6 % of the
// moment of cotton broad.  Moment and energy derive from one sum, so that M . dS = omega/4 sum M_d dK_d.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <MomentCurvatureLaw ScalarLaw>
struct FourDirections {
  static_assert(ScalarLaw::kDimension == 1);
  using Scalar = typename ScalarLaw::Scalar;
  using Real = Scalar;
  static constexpr int kDimension = 3;
  static constexpr int kDirections = 4;
  static constexpr int kScalarHistory = ScalarLaw::kHistory;
  static constexpr int kHistory = kDirections * kScalarHistory;

  static constexpr Real kBeta = Real(-0.17157287525380990240);  // -(sqrt2 - 1)^2
  static constexpr Real kScale = Real(1.202);                   // s
  static constexpr Real kWeight = Real(2.016);                  // omega
  // The rigidity over the scalar law's is omega s^2 (1 - beta)^2/4.
  static constexpr Real kElasticity = kWeight / kDirections * kScale * kScale * (1 - kBeta) * (1 - kBeta);

  ScalarLaw law;

  // Takes the fabric and the other parameters of the scalar law.
  template <class... Parameters>
  static FourDirections make(const VirginCurve& curve, const Parameters&... parameters) {
    return {ScalarLaw::make(curve, parameters...)};
  }

  HYST_HD LawStep<Real, 3, kHistory> step(const Vec<Real, 3>& curvature,
                                          const History<Real, kHistory>& before) const {
    LawStep<Real, 3, kHistory> result;
    result.moment.setZero();
    for (int d = 0; d < kDirections; ++d)
      add(along(d).step(Vec<Real, 1>(direction(d).dot(curvature)), part(before, d)), d, result);
    return result;
  }
  HYST_HD StepAndPotential<FourDirections> step_and_potential(const Vec<Real, 3>& curvature,
                                                              const History<Real, kHistory>& before) const {
    StepAndPotential<FourDirections> result{{}, 0};
    result.step.moment.setZero();
    for (int d = 0; d < kDirections; ++d) {
      const auto one =
          hysteron::step_and_potential(along(d), Vec<Real, 1>(direction(d).dot(curvature)), part(before, d));
      add(one.step, d, result.step);
      result.potential += one.potential;
    }
    result.potential = kWeight / kDirections * result.potential;
    return result;
  }

  HYST_HD Tangent<Real, 3> tangent(const Vec<Real, 3>& curvature,
                                   const History<Real, kHistory>& before) const {
    Tangent<Real, 3> result = Tangent<Real, 3>::Zero();
    for (int d = 0; d < kDirections; ++d) {
      const Vec<Real, 3> w = direction(d);
      const Real slope = along(d).tangent(Vec<Real, 1>(w.dot(curvature)), part(before, d))(0, 0);
      result += kWeight / kDirections * slope * w * w.transpose();
    }
    return result;
  }

  HYST_HD Vec<Real, 3> residual(const History<Real, kHistory>& history) const {
    return zero_moment(*this, history, Vec<Real, 3>(Vec<Real, 3>::Zero()));
  }
  HYST_HD History<Real, kHistory> ironed(const History<Real, kHistory>& before) const requires
      LawWithIroning<ScalarLaw> {
    History<Real, kHistory> after;
    for (int d = 0; d < kDirections; ++d) put_history(law.ironed(part(before, d)), after, d * kScalarHistory);
    return after;
  }
  // Returns the largest utilisation of the four directions.
  HYST_HD Real utilisation(const Vec<Real, 3>& curvature,
                           const History<Real, kHistory>& history) const requires LawWithUse<ScalarLaw> {
    Real most = 0;
    for (int d = 0; d < kDirections; ++d) {
      const Real one = law.utilisation(Vec<Real, 1>(direction(d).dot(curvature)), part(history, d));
      if (one > most) most = one;
    }
    return most;
  }
  HYST_HD Real largest_stiffness() const { return kElasticity * law.largest_stiffness(); }

  // Returns w_d, for K_d = w_d . S with d = 0..3.
  HYST_HD static Vec<Real, 3> direction(int d) {
    constexpr Real kNear = Real(0.85355339059327376220), kFar = Real(0.14644660940672623780);  // cos^2, sin^2
    constexpr Real kAlong = kScale * (kNear + kBeta * kFar), kAcross = kScale * (kFar + kBeta * kNear);
    constexpr Real kTwist = kScale * (1 - kBeta) / 2;  // s (1 - beta) sqrt2 |n_x n_y|, n_x n_y = +-sqrt2/4
    const bool along_x = d == 0 || d == 3;
    return {along_x ? kAlong : kAcross, along_x ? kAcross : kAlong, d < 2 ? kTwist : -kTwist};
  }

 private:
  // Returns the scalar law of direction d: 0 and 3 are bent along warp, 1 and 2 along weft.
  HYST_HD decltype(auto) along(int d) const {
    if constexpr (requires { law.along_weft(); })
      return d == 0 || d == 3 ? law : law.along_weft();
    else
      return (law);
  }
  HYST_HD static void add(const LawStep<Real, 1, kScalarHistory>& one, int d,
                          LawStep<Real, 3, kHistory>& sum) {
    sum.moment += kWeight / kDirections * one.moment[0] * direction(d);
    sum.stored += kWeight / kDirections * one.stored;
    sum.dissipated += kWeight / kDirections * one.dissipated;
    put_history(one.history, sum.history, d * kScalarHistory);
  }
  HYST_HD static History<Real, kScalarHistory> part(const History<Real, kHistory>& whole, int d) {
    return history_of<ScalarLaw>(whole, d * kScalarHistory);
  }
};

}  // namespace hysteron
