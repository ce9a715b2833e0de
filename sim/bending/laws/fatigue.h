// Fatigue: friction that weakens with the energy it has dissipated, and a permanent set that it leaves.
//
//   M = b2 (K - K_p) + m F,   m = M0(D)/M0,   M0(D) = M_inf + (M0 - M_inf) exp(-D/Dc)
//   dK_p = eta (m F/b2)(dm/m)   while m falls and friction holds a fold open: F . (K - K_p) < 0
//
// F is the friction of `Law` at full strength (a law with b2 = 0), D the energy lost per area so far.  Chosen
// here: the chapter announces weakening and a residual curvature that grows (4.1, 4.3.3) and gives no law,
// and no published one ties 2HB to dissipated energy.  m and K_p are those of the step's beginning within the
// step, and change at its end: the error is of first order in the energy of one step over Dc.
//
// A step loses m times the law's own loss, then, at its end, the energy of the friction that weakened and the
// elastic energy that the set takes; this is never negative for a law that never gives energy back.  Only
// energy that is lost weakens, not what `wong` gives back.  |K_p| <= eta (M0 - M_inf)/b2.  b2 = 0 has no set.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_parameters.h"
#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Law>
struct Fatigue {
  using Scalar = typename Law::Scalar;
  using Real = Scalar;
  static constexpr int kDimension = Law::kDimension;
  static constexpr int D = kDimension;
  static constexpr int kHistory = Law::kHistory + 1 + D;  // the law's history, D [J/m^2], K_p [1/m]
  using Memory = History<Real, kHistory>;

  Law law;           // friction alone, at full strength
  Real b2 = 0;       // rigidity of the straight branch [N m]
  Real m0 = 0;       // friction moment at full strength [N]
  Real dc = 1;       // Dc [J/m^2]
  Real m_least = 0;  // M_inf/M0
  Real eta = 1;      // share of the lost friction moment that sets

  // Takes as `friction` the law of a fabric {b1 - b2, 0, k0}: the curve without its straight branch.
  static Fatigue make(const VirginCurve& curve, const FatigueParams& choice, const Law& friction) {
    const double m0 = curve.friction_moment();
    return {friction,        Real(curve.b2), Real(m0), Real(choice.dc), Real(m0 > 0 ? choice.m_inf / m0 : 1),
            Real(choice.set)};
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    return weakened_step(law.step(curvature, history_of<Law>(before)), curvature, before);
  }
  HYST_HD StepAndPotential<Fatigue> step_and_potential(const Vec<Real, D>& curvature,
                                                       const Memory& before) const {
    const auto sound = hysteron::step_and_potential(law, curvature, history_of<Law>(before));
    return {weakened_step(sound.step, curvature, before),
            trial_potential(sound.potential, curvature, before)};
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    return b2 * Tangent<Real, D>::Identity() +
           strength(before) * law.tangent(curvature, history_of<Law>(before));
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const {
    return zero_moment(*this, history, load_set<Real, D>(history, kSet));
  }
  // Returns |F|/M0 of the law at full strength.
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Memory& history) const {
    return m0 > 0 ? called_step(law, curvature, history_of<Law>(history)).moment.norm() / m0 : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2 + law.largest_stiffness(); }

  // Ironing flattens the set and erases the memory of bends; weakened friction stays weak.
  HYST_HD Memory ironed(const Memory& before) const {
    Memory after;
    after[kSpent] = before[kSpent];
    return after;
  }

  // Returns K_p [1/m].
  HYST_HD static Vec<Real, D> set_curvature(const Memory& m) { return load_set<Real, D>(m, kSet); }
  HYST_HD Real strength(const Memory& m) const { return strength_at(m[kSpent]); }  // M0(D)/M0

 private:
  static constexpr int kSpent = Law::kHistory, kSet = kSpent + 1;
  struct Weakening {
    Real loss;         // decrease of m
    Vec<Real, D> set;  // change of K_p [1/m]
    Real released;     // energy that friction and elasticity lose by it [J/m^2]
  };

  // Completes a step of the law at full strength by weakening and set.
  HYST_HD LawStep<Real, D, kHistory> weakened_step(const LawStep<Real, D, Law::kHistory>& sound,
                                                   const Vec<Real, D>& curvature,
                                                   const Memory& before) const {
    const Vec<Real, D> elastic = curvature - load_set<Real, D>(before, kSet);
    const Real m = strength(before), slid = m * sound.dissipated,
               spent = before[kSpent] + (slid > 0 ? slid : Real(0));
    LawStep<Real, D, kHistory> result;
    result.moment = b2 * elastic + m * sound.moment;
    result.history = before;
    put_history(sound.history, result.history);

    // D includes the energy that weakening itself releases, which depends on the weakening: two rounds are
    // made.
    Weakening after = weakened(m, strength_at(spent), sound.moment, sound.stored, elastic);
    after = weakened(m, strength_at(spent + after.released), sound.moment, sound.stored, elastic);
    result.history[kSpent] = spent + after.released;
    after = weakened(m, strength(result.history), sound.moment, sound.stored, elastic);
    const Vec<Real, D> left = elastic - after.set;
    result.stored = b2 * left.squaredNorm() / 2 + (m - after.loss) * sound.stored;
    result.dissipated = slid + after.released;
    store_set<Real, D>(curvature - left, result.history, kSet);
    return result;
  }
  // Strength and set stay fixed within the step.
  HYST_HD Real trial_potential(Real sound, const Vec<Real, D>& curvature, const Memory& before) const {
    return b2 * (curvature - load_set<Real, D>(before, kSet)).squaredNorm() / 2 + strength(before) * sound;
  }
  HYST_HD Real strength_at(Real spent) const {
    using std::exp;
    return m_least + (1 - m_least) * exp(-spent / dc);
  }
  HYST_HD Weakening weakened(Real m, Real weaker, const Vec<Real, D>& friction, Real friction_energy,
                             const Vec<Real, D>& elastic) const {
    const Real loss = m > weaker ? m - weaker : Real(0);
    const Vec<Real, D> set = set_by(friction, elastic, loss);
    return {loss, set, loss * friction_energy + b2 * set.dot(elastic - set / 2)};
  }
  // Moves the set towards the fold, never so far that it would store energy.
  HYST_HD Vec<Real, D> set_by(const Vec<Real, D>& friction, const Vec<Real, D>& elastic,
                              Real weakened) const {
    if (!(b2 > 0 && weakened > 0 && friction.dot(elastic) < 0)) return Vec<Real, D>::Zero();
    const Vec<Real, D> set = -eta * weakened / b2 * friction;
    const Real most = set.dot(elastic), size = set.squaredNorm();
    return size > most ? Vec<Real, D>(most / size * set) : set;
  }
};

}  // namespace hysteron
