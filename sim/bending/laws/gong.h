// The law has a plastic rest curvature with hardening and a friction anchor, both depending on the time held
// (Gong et al. 2025; rules as published, thresholds in angle read as curvatures).
//
//   plastic:   e = K - K_p, yields at |e| > y: d = (|e| - y) b2/(k + b2), K_p += sgn(e) d, hard += d,
//              y = y0 + hard k/b2,  k = k_h (1 - (1 - exp(-t/tau)) k_h0)
//   friction:  u = K - anchor, slips at |u| > r(s) = r_inf - (r_inf - r_0) exp(-s/tau)
//   M = b2 (K - K_p) + (b1 - b2) u
//
// Two clocks: t, the time held, starts again at the end of a step that turned back; s, the time stuck, at the
// end of one in which the anchor slipped.  So a bend that is held strengthens the friction that its release
// meets.  Within a step both are fixed, so that the moment has a potential. k_h = 5 b2, k_h0 = 0.99, r_0 =
// r_inf/12, tau = 30 s are theirs.  Ours: y0 = `yield`, k0 by default; r_inf = K0/2, so that the friction
// moment held for long is M0 = HB.  The threshold falls when s starts again: the anchor slips on at once, and
// that energy is lost.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/plastic_return.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Real>
struct Gong {
  static constexpr int kDimension = 1;
  static constexpr int kHistory = 7;
  using Scalar = Real;
  using Memory = History<Real, kHistory>;

  Real b2 = 0;     // rigidity [N m]
  Real g = 0;      // stiffness of friction b1 - b2 [N m]
  Real yield = 0;  // y0 [1/m]
  Real limit = 0;  // r_inf [1/m]
  Real tau = 30;   // hold time [s]
  Real dt = 0;     // time of the step [s]

  static constexpr Real kHardening = 5;               // k_h/b2
  static constexpr Real kHardeningLost = Real(0.99);  // k_h0
  static constexpr Real kFirstLimit = Real(1) / 12;   // r_0/r_inf

  static Gong make(const VirginCurve& curve, double yield, double tau) {
    return {Real(curve.b2), Real(curve.b1 - curve.b2), Real(yield), Real(curve.k0 / 2), Real(tau), 0};
  }

  HYST_HD LawStep<Real, 1, kHistory> step(const Vec<Real, 1>& curvature, const Memory& before) const {
    const Real k = curvature[0];
    const Hold hold = hold_at(before);
    const Aged aged = aged_set(before, hold);
    const Real e = k - aged.set, n = absolute(e), y = threshold(aged.hard, hold);
    const PlasticReturn<Real> plastic = PlasticReturn<Real>::hardening(n, y, hold.kept);
    const Real elastic = e > 0 ? plastic.held : -plastic.held;
    const Real u = k - before[kAnchor], stretch = clamped(u, hold.limit);

    LawStep<Real, 1, kHistory> result;
    result.history = before;
    result.history[kSet] = n > plastic.held ? k - elastic : aged.set;
    result.history[kHard] = aged.hard + (n - plastic.held);
    remember_motion(k, before, result.history);
    const bool slips = absolute(u) > hold.limit;
    const Real kept = slips ? clamped(stretch, limit_after(0)) : stretch;
    result.history[kStuck] = slips ? Real(0) : before[kStuck] + dt;
    result.history[kAnchor] = k - kept;
    result.moment[0] = b2 * elastic + g * stretch;
    result.stored = (b2 * elastic * elastic + g * kept * kept) / 2;
    result.dissipated = b2 * (aged.lost + plastic.lost_by_yielding(n, y < n ? y : n)) +
                        g * hold.limit * (absolute(u) - absolute(stretch)) +
                        g * (stretch * stretch - kept * kept) / 2;
    return result;
  }

  HYST_HD Tangent<Real, 1> tangent(const Vec<Real, 1>& curvature, const Memory& before) const {
    const Hold hold = hold_at(before);
    const Aged aged = aged_set(before, hold);
    const Real n = absolute(curvature[0] - aged.set), u = curvature[0] - before[kAnchor];
    const Real plastic = PlasticReturn<Real>::hardening(n, threshold(aged.hard, hold), hold.kept).slope;
    return Tangent<Real, 1>(b2 * plastic + (absolute(u) > hold.limit ? Real(0) : g));
  }

  HYST_HD Vec<Real, 1> residual(const Memory& history) const {
    return zero_moment(*this, history, Vec<Real, 1>(history[kSet]));
  }
  HYST_HD Real utilisation(const Vec<Real, 1>& curvature, const Memory& history) const {  // returns |u|/r(s)
    const Real now = limit_after(history[kStuck]);
    return now > 0 ? absolute(curvature[0] - history[kAnchor]) / now : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2 + g; }

 private:
  enum Slot { kSet, kHard, kAnchor, kHeld, kPosition, kDirection, kStuck };
  struct Hold {
    Real k;      // hardening modulus over b2
    Real kept;   // k/(k + b2), share of the excess that stays elastic
    Real limit;  // r(s) [1/m]
  };
  struct Aged {
    // K_p and hard after a softer k has let the held stretch yield [1/m].
    Real set, hard;
    Real lost;  // loss per unit of stiffness [1/m^2]
  };

  HYST_HD static Real absolute(Real x) { return x < 0 ? -x : x; }
  HYST_HD static Real clamped(Real x, Real limit) { return x > limit ? limit : x < -limit ? -limit : x; }
  HYST_HD Real limit_after(Real stuck) const {
    using std::exp;
    return limit * (1 - (1 - kFirstLimit) * exp(-stuck / tau));
  }
  HYST_HD Hold hold_at(const Memory& m) const {
    using std::exp;
    const Real held = m[kHeld] + dt, k = kHardening * (1 - (1 - exp(-held / tau)) * kHardeningLost);
    return {k, k / (k + 1), limit_after(m[kStuck] + dt)};
  }
  HYST_HD Real threshold(Real hard, const Hold& hold) const { return yield + hard * hold.k; }
  HYST_HD Aged aged_set(const Memory& m, const Hold& hold) const {
    const Real e = m[kPosition] - m[kSet], n = absolute(e);
    const PlasticReturn<Real> now = PlasticReturn<Real>::hardening(n, threshold(m[kHard], hold), hold.kept);
    if (!(n > now.held)) return {m[kSet], m[kHard], 0};
    return {m[kPosition] - (e > 0 ? now.held : -now.held), m[kHard] + (n - now.held), now.lost_by_creep(n)};
  }
  HYST_HD void remember_motion(Real k, const Memory& before, Memory& after) const {
    const Real increment = k - before[kPosition], direction = increment > 0   ? Real(1)
                                                              : increment < 0 ? Real(-1)
                                                                              : Real(0);
    after[kHeld] = direction * before[kDirection] < 0 ? Real(0) : before[kHeld] + dt;
    if (direction != 0) after[kDirection] = direction;
    after[kPosition] = k;
  }
};

struct GongLaw {
  static constexpr const char* kName = "gong";
  static constexpr const char* kMeaning =
      "friction anchor and plastic rest curvature with hold time (Gong et al. 2025)";
  static constexpr LawFamily kFamily = LawFamily::hysteretic;
  static std::vector<LawParameter> parameters() { return {law_parameter::yield(), law_parameter::tau()}; }
  static void set_defaults(LawParams& c) { c.tau = 30; }  // hold time [s], theirs

  template <class Real, int>
  static Gong<Real> make(const LawParams& c) {
    return Gong<Real>::make(c.curve, c.yield, c.tau);
  }
};

}  // namespace hysteron
