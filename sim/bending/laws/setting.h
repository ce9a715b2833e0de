// A law whose rest curvature K_p sets permanently where its moment passes a limit that hardens.
//
//   M = law(K - K_p),   |M - h K_p| <= b2 K_y,   K_p moves along M - h K_p while it is at the limit
//
// h > 0 is the hardening: without it a fold gathers in one row of elements, sharper on every finer mesh. Over
// a step K_p moves by d to where
//   W_law(K - K_p - d) + h |K_p + d|^2/2 + b2 K_y |d|
// is least (closest point; convex in K and d together, hence in K).  Its slope by K is the law's moment, its
// tangent that of the law in series with the flow: T - T (T + H)^-1 T, H = h 1 + b2 K_y/|d| (1 - n n^T),
// n = d/|d|.  Lost by the flow: b2 K_y |d|.  For one component that is d = (|M - h K_p| - b2 K_y)/(T + h) on
// straight branches; a tensor flows along the direction that the minimum has, which for a cylinder is its
// own. Chosen here, not in a source: the form, linear hardening, and that the whole moment drives the flow.
#pragma once

#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/plastic_return.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Law>
struct Setting {
  using Scalar = typename Law::Scalar;
  using Real = Scalar;
  static constexpr int kDimension = Law::kDimension;
  static constexpr int D = kDimension;
  static constexpr bool kRelaxes = RelaxingLaw<Law>;
  static constexpr int kHistory = Law::kHistory + D;  // the law's, K_p [1/m]
  using Memory = History<Real, kHistory>;

  Law law;
  Real limit = 0;      // b2 K_y [N]
  Real hardening = 1;  // h [N m]

  static Setting make(const Law& law, double b2, const PermanentSet& set) {
    return {law, Real(b2 * set.yield), Real(set.hardening)};
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> moved = flow(curvature, before);
    return step_around(law.step(Vec<Real, D>(curvature - (set_of(before) + moved)), part(before)), moved,
                       before);
  }
  HYST_HD TriedStep<Setting> tried_step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> moved = flow(curvature, before), set = set_of(before) + moved;
    const auto inner = hysteron::tried_step(law, Vec<Real, D>(curvature - set), part(before));
    return {step_around(inner.step, moved, before), with_cost_of(moved, set, inner.potential)};
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> moved = flow(curvature, before);
    const Tangent<Real, D> stiff =
        law.tangent(Vec<Real, D>(curvature - set_of(before) - moved), part(before));
    if (!(moved.norm() > 0)) return stiff;
    const Tangent<Real, D> sum = stiff + flow_stiffness(moved);
    Tangent<Real, D> soft;
    for (int c = 0; c < D; ++c) soft.col(c) = solve_definite<Real, D>(sum, Vec<Real, D>(stiff.col(c)));
    const Tangent<Real, D> product = stiff * soft;
    return stiff - (product + product.transpose()) / 2;
  }
  HYST_HD Real potential(const Vec<Real, D>& curvature, const Memory& before) const {
    return potential_of(flow(curvature, before), curvature, before);
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const {
    Setting at_once = *this;
    if constexpr (TimedLaw<Law>) at_once.law.dt = 0;
    return zero_moment(at_once, history, set_of(history));
  }
  HYST_HD Real used(const Vec<Real, D>& curvature, const Memory& history) const requires LawWithUse<Law> {
    return law.used(Vec<Real, D>(curvature - set_of(history)), part(history));
  }
  HYST_HD Real largest_stiffness() const { return law.largest_stiffness(); }

  HYST_HD static Vec<Real, D> set_of(const Memory& m) {  // K_p [1/m]
    return load_set<Real, D>(m, Law::kHistory);
  }

 private:
  static constexpr Real kPrecision = Real(sizeof(Real) == 8 ? 1e-13 : 2e-6);  // of the moments in balance

  HYST_HD static History<Real, Law::kHistory> part(const Memory& whole) {
    History<Real, Law::kHistory> result;
    for (int i = 0; i < Law::kHistory; ++i) result[i] = whole[i];
    return result;
  }

  HYST_HD Tangent<Real, D> flow_stiffness(const Vec<Real, D>& moved) const {
    const Real size = moved.norm();
    const Tangent<Real, D> one = Tangent<Real, D>::Identity();
    return hardening * one + limit / size * (one - moved * moved.transpose() / (size * size));
  }
  // With what the law makes of the step from its rest curvature.
  HYST_HD LawStep<Real, D, kHistory> step_around(const LawStep<Real, D, Law::kHistory>& inner,
                                                 const Vec<Real, D>& moved, const Memory& before) const {
    const Vec<Real, D> set = set_of(before) + moved;
    LawStep<Real, D, kHistory> result;
    for (int i = 0; i < Law::kHistory; ++i) result.history[i] = inner.history[i];
    store_set<Real, D>(set, result.history, Law::kHistory);
    result.moment = inner.moment;
    result.stored = inner.stored + hardening * set.squaredNorm() / 2;
    result.dissipated = inner.dissipated + limit * moved.norm();
    result.relaxed = inner.relaxed;
    return result;
  }
  // The law's potential, what hardening stores and what the flow loses.
  HYST_HD Real with_cost_of(const Vec<Real, D>& moved, const Vec<Real, D>& set, Real potential) const {
    return potential + hardening * set.squaredNorm() / 2 + limit * moved.norm();
  }
  HYST_HD Real potential_of(const Vec<Real, D>& moved, const Vec<Real, D>& curvature,
                            const Memory& before) const {
    const Vec<Real, D> set = set_of(before) + moved;
    return with_cost_of(moved, set, step_potential(law, Vec<Real, D>(curvature - set), part(before)));
  }

  // d of the step, by damped Newton steps on its potential.  From the length that the law's largest stiffness
  // would leave, which is no more than the step's, so that d is never zero on the way.
  // Inlined, though it holds the whole law: called on a GPU, it wrote beyond the stack that nvcc 13.0 had
  // given it.  So that it holds it but once for each of step, potential and tangent, first look, steps and
  // halvings are one loop.
  HYST_HD Vec<Real, D> flow(const Vec<Real, D>& curvature, const Memory& before) const {
    constexpr int kMostSteps = 40, kMostHalvings = 20;
    constexpr Real kEnoughDescent = Real(1e-4);  // Armijo's fraction of the predicted decrease
    const Vec<Real, D> old = set_of(before);
    const auto past = part(before);
    Vec<Real, D> moved = Vec<Real, D>::Zero(), next = moved, newton = moved;
    Real fraction = 1, precise = 0, half_slope = 0, descent = 0;
    int halvings = 0;
    for (int steps = -1; steps <= kMostSteps;) {
      const Vec<Real, D> set = old + next;
      const Vec<Real, D> driving = law.step(Vec<Real, D>(curvature - set), past).moment - hardening * set;
      if (steps < 0) {  // does it flow at all?
        const Real size = driving.norm();
        precise = kPrecision * (size + 2 * hardening * old.norm() + limit);
        if (!(size > limit + precise)) return moved;
        next = (size - limit) / ((law.largest_stiffness() + hardening) * size) * driving;
        steps = 0;
        continue;
      }
      const Vec<Real, D> slope = limit / next.norm() * next - driving;
      if (steps > 0 && !(slope.norm() <= half_slope) &&  // as it nearly always is; else the potential decides
          !descends(next, moved, fraction * descent, curvature, before) && ++halvings < kMostHalvings) {
        fraction /= 2;
        next = moved + fraction * newton;
        continue;
      }
      moved = next;
      if (steps == kMostSteps || !(slope.norm() > precise)) return moved;
      const Tangent<Real, D> stiff =
          law.tangent(Vec<Real, D>(curvature - old - moved), past) + flow_stiffness(moved);
      newton = -solve_definite<Real, D>(stiff, slope);
      descent = kEnoughDescent * slope.dot(newton);
      half_slope = slope.norm() / 2;
      fraction = 1, halvings = 0;
      next = moved + newton;
      ++steps;
    }
    return moved;
  }
  // Whether the potential falls by so much from one flow to another.
  HYST_HD bool descends(const Vec<Real, D>& to, const Vec<Real, D>& from, Real by,
                        const Vec<Real, D>& curvature, const Memory& before) const {
    Real potential[2];
    HYST_UNROLL(1)
    for (int end = 0; end < 2; ++end) potential[end] = potential_of(end == 0 ? to : from, curvature, before);
    return potential[0] <= potential[1] + by;
  }
};

}  // namespace hysteron
