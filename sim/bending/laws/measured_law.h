// Builds a law as a type from a fabric's parts beyond three numbers: stops, relaxing branches beside them,
// both behind a rest curvature that sets.
//
// A part that the fabric lacks is not in the type, so that it takes neither history nor time.  The number of
// stops has two capacities: each is a type of its own and takes its time to compile.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_parameters.h"
#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/spectrum_stops.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

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
template <class Law>
struct PermanentSetLaw {
  using Scalar = typename Law::Scalar;
  using Real = Scalar;
  static constexpr int kDimension = Law::kDimension;
  static constexpr int D = kDimension;
  static constexpr bool kRelaxes = RelaxingLaw<Law>;
  static constexpr int kHistory = Law::kHistory + D;  // the law's history, K_p [1/m]
  using Memory = History<Real, kHistory>;

  Law law;
  Real limit = 0;      // b2 K_y [N]
  Real hardening = 1;  // h [N m]

  static PermanentSetLaw make(const Law& law, double b2, const PermanentSet& set) {
    return {law, Real(b2 * set.yield), Real(set.hardening)};
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> moved = flow(curvature, before);
    return step_around(
        law.step(Vec<Real, D>(curvature - (set_curvature(before) + moved)), history_of<Law>(before)), moved,
        before);
  }
  HYST_HD StepAndPotential<PermanentSetLaw> step_and_potential(const Vec<Real, D>& curvature,
                                                               const Memory& before) const {
    const Vec<Real, D> moved = flow(curvature, before), set = set_curvature(before) + moved;
    const auto inner =
        hysteron::step_and_potential(law, Vec<Real, D>(curvature - set), history_of<Law>(before));
    return {step_around(inner.step, moved, before), with_flow_cost(moved, set, inner.potential)};
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> moved = flow(curvature, before);
    const Tangent<Real, D> stiff =
        law.tangent(Vec<Real, D>(curvature - set_curvature(before) - moved), history_of<Law>(before));
    if (!(moved.norm() > 0)) return stiff;
    const Tangent<Real, D> sum = stiff + flow_stiffness(moved);
    Tangent<Real, D> soft;
    for (int c = 0; c < D; ++c) soft.col(c) = solve_definite<Real, D>(sum, Vec<Real, D>(stiff.col(c)));
    const Tangent<Real, D> product = stiff * soft;
    return stiff - (product + product.transpose()) / 2;
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const {
    PermanentSetLaw at_once = *this;
    if constexpr (TimedLaw<Law>) at_once.law.dt = 0;
    return zero_moment(at_once, history, set_curvature(history));
  }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature,
                           const Memory& history) const requires LawWithUse<Law> {
    return law.utilisation(Vec<Real, D>(curvature - set_curvature(history)), history_of<Law>(history));
  }
  HYST_HD Real largest_stiffness() const { return law.largest_stiffness(); }

  HYST_HD static Vec<Real, D> set_curvature(const Memory& m) {  // returns K_p [1/m]
    return load_set<Real, D>(m, Law::kHistory);
  }

 private:
  // Precision of the balance, relative to its moments.
  static constexpr Real kPrecision = Real(sizeof(Real) == 8 ? 1e-13 : 2e-6);

  HYST_HD Tangent<Real, D> flow_stiffness(const Vec<Real, D>& moved) const {
    const Real size = moved.norm();
    const Tangent<Real, D> one = Tangent<Real, D>::Identity();
    return hardening * one + limit / size * (one - moved * moved.transpose() / (size * size));
  }
  // Completes the law's own step from the moved rest curvature.
  HYST_HD LawStep<Real, D, kHistory> step_around(const LawStep<Real, D, Law::kHistory>& inner,
                                                 const Vec<Real, D>& moved, const Memory& before) const {
    const Vec<Real, D> set = set_curvature(before) + moved;
    LawStep<Real, D, kHistory> result;
    put_history(inner.history, result.history);
    store_set<Real, D>(set, result.history, Law::kHistory);
    result.moment = inner.moment;
    result.stored = inner.stored + hardening * set.squaredNorm() / 2;
    result.dissipated = inner.dissipated + limit * moved.norm();
    result.relaxed = inner.relaxed;
    return result;
  }
  // Adds up the law's potential, the energy that hardening stores and the flow's loss.
  HYST_HD Real with_flow_cost(const Vec<Real, D>& moved, const Vec<Real, D>& set, Real potential) const {
    return potential + hardening * set.squaredNorm() / 2 + limit * moved.norm();
  }
  HYST_HD Real trial_potential(const Vec<Real, D>& moved, const Vec<Real, D>& curvature,
                               const Memory& before) const {
    const Vec<Real, D> set = set_curvature(before) + moved;
    return with_flow_cost(moved, set,
                          step_potential(law, Vec<Real, D>(curvature - set), history_of<Law>(before)));
  }

  // Damped Newton steps on the potential of the step, from one flow that is accepted to the next.
  struct FlowSearch {
    Vec<Real, D> moved = Vec<Real, D>::Zero();   // the flow accepted last [1/m]
    Vec<Real, D> newton = Vec<Real, D>::Zero();  // the Newton step from there [1/m]
    Vec<Real, D> trial = Vec<Real, D>::Zero();   // the flow that is tried, a fraction of that step away [1/m]
    Real fraction = 1;
    Real half_slope = 0;  // half of the slope's size there: a trial with less is good [N]
    Real descent = 0;     // the decrease of the potential that the whole Newton step has to reach
    int steps = 0, halvings = 0;

    // Tries half of the fraction; false if it has been halved often enough.
    HYST_HD bool halve() {
      constexpr int kMaxHalvings = 20;
      if (++halvings == kMaxHalvings) return false;
      fraction /= 2;
      trial = moved + fraction * newton;
      return true;
    }
    // Tries a whole Newton step from the flow accepted last, where the potential has this slope.
    HYST_HD void go_on(const Vec<Real, D>& slope, const Vec<Real, D>& step) {
      constexpr Real kEnoughDescent = Real(1e-4);  // Armijo's fraction of the predicted decrease
      newton = step;
      descent = kEnoughDescent * slope.dot(newton);
      half_slope = slope.norm() / 2;
      fraction = 1;
      halvings = 0;
      trial = moved + newton;
      ++steps;
    }
  };

  // Finds d of the step.  The search begins at the length that the law's largest stiffness would leave, which
  // is no more than the step's, so that d is never zero on the way.  The function is inlined, though it holds
  // the whole law: as a call on a GPU it wrote beyond the stack that nvcc 13.0 had given it.  First look,
  // steps and halvings are one loop, so that the law is inlined only once for each of step, potential and
  // tangent.
  HYST_HD Vec<Real, D> flow(const Vec<Real, D>& curvature, const Memory& before) const {
    constexpr int kMaxSteps = 40;
    const Vec<Real, D> old = set_curvature(before);
    const auto past = history_of<Law>(before);
    FlowSearch search;
    Real precise = 0;  // slopes below this are rounding [N]
    for (bool begun = false; search.steps <= kMaxSteps;) {
      const Vec<Real, D> set = old + search.trial;
      const Vec<Real, D> driving = law.step(Vec<Real, D>(curvature - set), past).moment - hardening * set;
      if (!begun) {  // does it flow at all?
        const Real size = driving.norm();
        precise = kPrecision * (size + 2 * hardening * old.norm() + limit);
        if (!(size > limit + precise)) return search.moved;
        search.trial = (size - limit) / ((law.largest_stiffness() + hardening) * size) * driving;
        begun = true;
        continue;
      }
      const Vec<Real, D> slope = limit / search.trial.norm() * search.trial - driving;
      // A step that halves the slope is good, as nearly all are; else the potential decides.
      const bool good =
          search.steps == 0 || slope.norm() <= search.half_slope ||
          descends(search.trial, search.moved, search.fraction * search.descent, curvature, before);
      if (!good && search.halve()) continue;
      search.moved = search.trial;
      if (search.steps == kMaxSteps || !(slope.norm() > precise)) return search.moved;
      const Tangent<Real, D> stiff =
          law.tangent(Vec<Real, D>(curvature - old - search.moved), past) + flow_stiffness(search.moved);
      search.go_on(slope, -solve_definite<Real, D>(stiff, slope));
    }
    return search.moved;
  }
  // Does the potential fall by at least `by` from one flow to another?
  HYST_HD bool descends(const Vec<Real, D>& to, const Vec<Real, D>& from, Real by,
                        const Vec<Real, D>& curvature, const Memory& before) const {
    Real potential[2];
    HYST_UNROLL(1)
    for (int end = 0; end < 2; ++end)
      potential[end] = trial_potential(end == 0 ? to : from, curvature, before);
    return potential[0] <= potential[1] + by;
  }
};

// Puts relaxing branches beside a law of elasticity and friction: springs c_i in series with dashpots,
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

// The coefficients of a branch for a step of x = h/tau.
template <class Real>
struct Relaxation {
  Real left;        // e^-x
  Real stiff;       // (1 - e^-x)/x
  Real f0, f1, f2;  // coefficients of the loss

  HYST_HD static Relaxation over(Real x) {
    using std::exp;
    using std::expm1;
    constexpr Real kSeries = Real(sizeof(Real) == 8 ? 1e-2 : 0.3);  // below this x series are used
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
  static constexpr int kHistory = Law::kHistory + (1 + B) * D;  // the law's history, K [1/m], m_i [N]
  using Memory = History<Real, kHistory>;

  Law law;
  Real c[B] = {};    // stiffnesses [N m]; 0: no branch
  Real tau[B] = {};  // times [s]
  Real dt = 0;       // time of the step [s]

  // Takes at most B branches.
  static Relaxing make(const Law& law, const RelaxingBranches& branches) {
    Relaxing result{law};
    for (std::size_t i = 0; i < B; ++i) {
      result.c[i] = Real(i < branches.size() ? branches.stiffnesses[i] : 0);
      result.tau[i] = Real(i < branches.size() ? branches.times[i] : 1);
    }
    return result;
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    return step_around(law.step(curvature, history_of<Law>(before)), curvature, before);
  }
  HYST_HD StepAndPotential<Relaxing> step_and_potential(const Vec<Real, D>& curvature,
                                                        const Memory& before) const {
    const auto inner = hysteron::step_and_potential(law, curvature, history_of<Law>(before));
    return {step_around(inner.step, curvature, before), potential_around(inner.potential, curvature, before)};
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    Real stiff = 0;
    for (int i = 0; i < B; ++i) stiff += c[i] * Relaxation<Real>::over(dt / tau[i]).stiff;
    return law.tangent(curvature, history_of<Law>(before)) + stiff * Tangent<Real, D>::Identity();
  }
  // Computes the potential alone, for a law around this one that sets.
  HYST_HD Real potential(const Vec<Real, D>& curvature, const Memory& before) const {
    return potential_around(step_potential(law, curvature, history_of<Law>(before)), curvature, before);
  }
  // Unloads at once, so that branches act as springs.
  HYST_HD Vec<Real, D> residual(const Memory& history) const {
    Relaxing at_once = *this;
    at_once.dt = 0;
    return zero_moment(at_once, history, load_set<Real, D>(history, kCurvature));
  }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature,
                           const Memory& history) const requires LawWithUse<Law> {
    return law.utilisation(curvature, history_of<Law>(history));
  }
  HYST_HD Real largest_stiffness() const {
    Real sum = law.largest_stiffness();
    for (int i = 0; i < B; ++i) sum += c[i];
    return sum;
  }

 private:
  static constexpr int kCurvature = Law::kHistory, kBranch = kCurvature + D;

  // Completes the law's own step by the branches.
  HYST_HD LawStep<Real, D, kHistory> step_around(const LawStep<Real, D, Law::kHistory>& inner,
                                                 const Vec<Real, D>& curvature, const Memory& before) const {
    LawStep<Real, D, kHistory> result;
    put_history(inner.history, result.history);
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

// Returns the fabric's stops along warp, or those of b1, b2 and k0 (prandtl_stops.h): as many as the law has,
// or the largest number where it would remember by a stack.
inline Spectrum measured_stops(const LawParams& c) {
  if (!c.curve.parts.stops.empty()) return c.curve.parts.stops;
  return parabola_stops(c.curve.b1 - c.curve.b2, c.curve.k0, c.stack ? kMaxStops : c.stops);
}

// The capacity of a law for few stops; others have room for kMaxStops.
constexpr int kFewStops = 8;
inline int room_for_stops(const LawParams& c) {
  return measured_stops(c).size() <= kFewStops ? kFewStops : kMaxStops;
}

// Calls visit(law) with these branches around the stops, and a set if the fabric has one; returns false where
// the group (every_law.h) has no room for the stops, or for the branches.
template <class Real, int D, class Group, class Visit>
bool visit_measured(const LawParams& c, const RelaxingBranches& branches, const Visit& visit) {
  if (room_for_stops(c) != Group::kStops) return false;
  if (branches.empty() ? !Group::kWithoutBranches : !Group::kWithBranches) return false;
  const BendingParts& parts = c.curve.parts;
  const auto stops =
      SpectrumStops<Real, D, Group::kStops>::make(c.curve.b2, measured_stops(c), parts.weft_stops);
  const auto setting_or_not = [&]<class Law>(const Law& law) {
    if (parts.set.on())
      visit(PermanentSetLaw<Law>::make(law, c.curve.b2, parts.set));
    else
      visit(law);
  };
  if constexpr (Group::kWithoutBranches)
    if (branches.empty()) setting_or_not(stops);
  if constexpr (Group::kWithBranches)
    if (!branches.empty())
      setting_or_not(Relaxing<SpectrumStops<Real, D, Group::kStops>, kMaxBranches>::make(stops, branches));
  return true;
}

}  // namespace hysteron
