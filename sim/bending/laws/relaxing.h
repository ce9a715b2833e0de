// A law of elasticity and friction with relaxing branches beside it: springs c_i in series with dashpots.
//
//   dm_i/dt = c_i dK/dt - m_i/tau_i
//
// The generalised linear viscoelasticity with a frictional couple of the textile literature on wrinkle
// recovery (Chapman 1974, 1975; quoted second-hand: the form is ours).  Over a step of any length h in which
// K is linear, with x = h/tau and dK the change of K, exactly
//   m' = e^-x m + a dK,   a = c (1 - e^-x)/x
// which is the derivative of |dK|^2 a/2 + e^-x m . dK, convex for any h.  Dashpots lose, by the integral of
// |m|^2/(c tau) over the step,
//   (f0 |m|^2 + 2 f1 m . (c dK) + f2 |c dK|^2)/c,
//   f0 = (1 - e^-2x)/2,  f1 = (1 - e^-x)^2/(2x),  f2 = ((1 - e^-2x)/2 - 2 (1 - e^-x) + x)/x^2.
// Without time, h = 0, a branch is a spring.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_parameters.h"
#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/plastic_return.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

// What a step of x = h/tau makes of a branch.
template <class Real>
struct Relaxation {
  Real left;        // e^-x
  Real stiff;       // (1 - e^-x)/x
  Real f0, f1, f2;  // of the loss

  HYST_HD static Relaxation over(Real x) {
    using std::exp;
    using std::expm1;
    constexpr Real kSeries = Real(sizeof(Real) == 8 ? 1e-2 : 0.3);  // below: differences by their series
    const Real gone = -expm1(-x), gone_twice = -expm1(-2 * x) / 2;
    if (!(x > 0)) return {1, 1, 0, 0, 0};
    const Real series =
        x * (Real(1) / 3 - x * (Real(1) / 4 - x * (Real(7) / 60 - x * (Real(1) / 24 - x * Real(31) / 2520))));
    const Real f2 = x < kSeries ? series : (gone_twice - 2 * gone + x) / (x * x);
    return {exp(-x), gone / x, gone_twice, gone * gone / (2 * x), f2};
  }
};

template <class Law, int B>
struct Relaxing {
  using Scalar = typename Law::Scalar;
  using Real = Scalar;
  static constexpr int kDimension = Law::kDimension;
  static constexpr int D = kDimension;
  static constexpr bool kRelaxes = true;
  static constexpr int kHistory = Law::kHistory + (1 + B) * D;  // the law's, K [1/m], m_i [N]
  using Memory = History<Real, kHistory>;

  Law law;
  Real c[B] = {};    // stiffnesses [N m]; 0: no branch
  Real tau[B] = {};  // times [s]
  Real dt = 0;       // time of the step [s]

  // At most B branches.
  static Relaxing make(const Law& law, const RelaxingBranches& branches) {
    Relaxing result{law};
    for (std::size_t i = 0; i < B; ++i) {
      result.c[i] = Real(i < branches.size() ? branches.stiffnesses[i] : 0);
      result.tau[i] = Real(i < branches.size() ? branches.times[i] : 1);
    }
    return result;
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    return step_around(law.step(curvature, part(before)), curvature, before);
  }
  HYST_HD TriedStep<Relaxing> tried_step(const Vec<Real, D>& curvature, const Memory& before) const {
    const auto inner = hysteron::tried_step(law, curvature, part(before));
    return {step_around(inner.step, curvature, before), potential_around(inner.potential, curvature, before)};
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    Real stiff = 0;
    for (int i = 0; i < B; ++i) stiff += c[i] * Relaxation<Real>::over(dt / tau[i]).stiff;
    return law.tangent(curvature, part(before)) + stiff * Tangent<Real, D>::Identity();
  }
  HYST_HD Real potential(const Vec<Real, D>& curvature, const Memory& before) const {
    return potential_around(step_potential(law, curvature, part(before)), curvature, before);
  }
  // At once, as springs.
  HYST_HD Vec<Real, D> residual(const Memory& history) const {
    Relaxing at_once = *this;
    at_once.dt = 0;
    return zero_moment(at_once, history, load_set<Real, D>(history, kCurvature));
  }
  HYST_HD Real used(const Vec<Real, D>& curvature, const Memory& history) const requires LawWithUse<Law> {
    return law.used(curvature, part(history));
  }
  HYST_HD Real largest_stiffness() const {
    Real sum = law.largest_stiffness();
    for (int i = 0; i < B; ++i) sum += c[i];
    return sum;
  }

 private:
  static constexpr int kCurvature = Law::kHistory, kBranch = kCurvature + D;

  HYST_HD static History<Real, Law::kHistory> part(const Memory& whole) {
    History<Real, Law::kHistory> result;
    for (int i = 0; i < Law::kHistory; ++i) result[i] = whole[i];
    return result;
  }
  // With what the law itself makes of the step.
  HYST_HD LawStep<Real, D, kHistory> step_around(const LawStep<Real, D, Law::kHistory>& inner,
                                                 const Vec<Real, D>& curvature, const Memory& before) const {
    LawStep<Real, D, kHistory> result;
    for (int i = 0; i < Law::kHistory; ++i) result.history[i] = inner.history[i];
    store_set<Real, D>(curvature, result.history, kCurvature);
    result.moment = inner.moment;
    result.stored = inner.stored;
    const Vec<Real, D> change = curvature - load_set<Real, D>(before, kCurvature);
    for (int i = 0; i < B; ++i) {
      if (!(c[i] > 0)) continue;
      const Relaxation<Real> now = Relaxation<Real>::over(dt / tau[i]);
      const Vec<Real, D> old = load_set<Real, D>(before, kBranch + i * D), strained = c[i] * change;
      const Vec<Real, D> moment = now.left * old + now.stiff * strained;
      result.moment += moment;
      result.stored += moment.squaredNorm() / (2 * c[i]);
      result.relaxed +=
          (now.f0 * old.squaredNorm() + 2 * now.f1 * old.dot(strained) + now.f2 * strained.squaredNorm()) /
          c[i];
      store_set<Real, D>(moment, result.history, kBranch + i * D);
    }
    result.dissipated = inner.dissipated + result.relaxed;
    return result;
  }
  HYST_HD Real potential_around(Real inner, const Vec<Real, D>& curvature, const Memory& before) const {
    Real sum = inner;
    const Vec<Real, D> change = curvature - load_set<Real, D>(before, kCurvature);
    for (int i = 0; i < B; ++i) {
      if (!(c[i] > 0)) continue;
      const Relaxation<Real> now = Relaxation<Real>::over(dt / tau[i]);
      sum += now.stiff * c[i] * change.squaredNorm() / 2 +
             now.left * load_set<Real, D>(before, kBranch + i * D).dot(change);
    }
    return sum;
  }
};

}  // namespace hysteron
