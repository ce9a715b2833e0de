// The chapter's own reading of the hysteresis loop: only the last reversal is remembered.
//
// M = b2 K + F.  After a reversal at (K_r, F_r), moving in direction s = +-1 (x = |K - K_r|):
//   F = s M0 - (s M0 - F_r)(1 - u)^2,   u = min(x/S, 1),   S = 2 (M0 - s F_r)/(b1 - b2)
// slope b1 at the reversal, tangent to the opposite straight line.  From rest S = K0: the virgin curve (Wong,
// Eq. 4.2); from the opposite line S = 2 K0: Eqs. 4.4 and 4.5.  For partial reversals the chapter promises
// coefficients and breaks off: this S is chosen here.  So is `reversible`, for its claim (after Anandjiwala &
// Leaf 1991) that bending up to the elastic limit recovers fully: a reversal from the virgin branch at
// |K_r| <= K0 goes back to the origin on
//   M = M_r + b1 (K - K_r) -+ c1 (K - K_r)^2,
// is virgin again there, and loses |c1| |K_r|^3/3; a reversal on it continues as a branch of the first kind.
//
// Minor loops do not close and the law is not passive: stored = b2 K^2/2 only, and `dissipated` is the work
// of friction, int F dK, which may fall after a reversal.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"

namespace hysteron {

enum class Recovery { kMasing, kReversible };

template <class Real>
struct Wong {
  static constexpr int kDimension = 1;
  static constexpr int kHistory = 5;
  using Scalar = Real;
  using Memory = History<Real, kHistory>;

  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real g = 0;   // friction stiffness b1 - b2 [N m]
  Real k0 = 0;  // elastic limit [1/m]
  Real m0 = 0;  // friction moment [N]
  Recovery recovery = Recovery::kMasing;

  static Wong make(const VirginCurve& curve, Recovery recovery = Recovery::kMasing) {
    const bool friction = curve.k0 > 0 && curve.b1 > curve.b2;
    if (!friction) return {Real(curve.b2), 0, 0, 0, recovery};
    return {Real(curve.b2), Real(curve.b1 - curve.b2), Real(curve.k0), Real(curve.friction_moment()),
            recovery};
  }

  HYST_HD LawStep<Real, 1, kHistory> step(const Vec<Real, 1>& curvature, const Memory& before) const {
    LawStep<Real, 1, kHistory> result;
    result.history = before;
    result.dissipated = travel(curvature[0], result.history);
    result.moment[0] = b2 * curvature[0] + friction(result.history, curvature[0]);
    result.stored = b2 * curvature[0] * curvature[0] / 2;
    return result;
  }
  HYST_HD Tangent<Real, 1> tangent(const Vec<Real, 1>& curvature, const Memory& before) const {
    Memory after = before;
    travel(curvature[0], after);
    return Tangent<Real, 1>(b2 + slope(after, curvature[0]));
  }

  HYST_HD Vec<Real, 1> residual(const Memory& history) const {
    Memory m = history;
    const Real moment = b2 * m[kCurvature] + friction(m, m[kCurvature]);
    if (moment == 0) return Vec<Real, 1>(m[kCurvature]);
    turn_towards(moment > 0 ? Real(-1) : Real(1), m);
    return Vec<Real, 1>(m[kBranch] == kReturning ? Real(0) : root(m));
  }
  HYST_HD Real largest_stiffness() const { return b2 + g; }

 private:
  enum Slot { kCurvature, kDirection, kTurnCurvature, kTurnFriction, kBranch };
  static constexpr int kVirgin = 0, kTurned = 1, kReturning = 2;

  HYST_HD static Real travelled(const Memory& m, Real k) { return m[kDirection] * (k - m[kTurnCurvature]); }
  // Returns |s M0 - F_r| [N].
  HYST_HD Real gap(const Memory& m) const { return m0 - m[kDirection] * m[kTurnFriction]; }
  HYST_HD Real span(const Memory& m) const { return g > 0 ? 2 * gap(m) / g : Real(0); }  // S [1/m]

  // Computes friction from differences to the reversal: nothing cancels where k0, and with it the remaining
  // friction, is large.
  HYST_HD Real friction(const Memory& m, Real k) const {
    const Real s = m[kDirection], x = travelled(m, k);
    if (m[kBranch] == kReturning) return m[kTurnFriction] + s * x * (g - returning_bend() * x);
    const Real end = span(m);
    return x < end ? m[kTurnFriction] + s * g * x * (1 - x / (2 * end)) : s * m0;
  }
  HYST_HD Real slope(const Memory& m, Real k) const {
    if (m[kDirection] == 0) return g;
    const Real x = travelled(m, k);
    if (m[kBranch] == kReturning) return g - 2 * returning_bend() * x;
    const Real end = span(m);
    return x < end ? g * (1 - x / end) : Real(0);
  }
  // Returns int F dK from the reversal to k on a direct way [J/m^2].
  HYST_HD Real work(const Memory& m, Real k) const {
    const Real x = travelled(m, k), reversal = m[kDirection] * m[kTurnFriction];
    if (m[kBranch] == kReturning) return reversal * x + x * x * (g / 2 - returning_bend() * x / 3);
    const Real end = span(m);
    if (x < end) return reversal * x + g * x * x * (Real(0.5) - x / (6 * end));
    return reversal * end + g * end * end / 3 + m0 * (x - end);
  }
  HYST_HD Real returning_bend() const { return k0 > 0 ? g / (2 * k0) : Real(0); }  // |c1| [N m^2]

  // Moves to `k` and returns the work of friction on the way [J/m^2].
  HYST_HD Real travel(Real k, Memory& m) const {
    const Real increment = k - m[kCurvature];
    if (increment == 0) return 0;
    turn_towards(increment > 0 ? Real(1) : Real(-1), m);
    Real spent = -work(m, m[kCurvature]);
    if (m[kBranch] == kReturning && m[kDirection] * k >= 0) {
      spent += work(m, Real(0));
      m[kTurnCurvature] = m[kTurnFriction] = 0, m[kBranch] = kVirgin;
    }
    m[kCurvature] = k;
    return spent + work(m, k);
  }

  HYST_HD void turn_towards(Real direction, Memory& m) const {
    using std::abs;
    if (direction * m[kDirection] < 0) {
      const bool elastic = m[kBranch] == kVirgin && abs(m[kCurvature]) <= k0;
      m[kTurnFriction] = friction(m, m[kCurvature]);
      m[kTurnCurvature] = m[kCurvature];
      m[kBranch] = elastic && recovery == Recovery::kReversible ? kReturning : kTurned;
    }
    m[kDirection] = direction;
  }

  // Returns the curvature at which b2 K + F = 0 ahead on this branch: a v^2 + b v - c = 0 for v = 1 - u, else
  // -s M0/b2.
  HYST_HD Real root(const Memory& m) const {
    using std::sqrt;
    const Real s = m[kDirection], a = gap(m), end = span(m), b = b2 * end;
    const Real c = s * b2 * m[kTurnCurvature] + b + m0;
    if (!(c > 0)) return b2 > 0 ? -s * m0 / b2 : m[kCurvature];
    return m[kTurnCurvature] + s * end * (1 - 2 * c / (b + sqrt(b * b + 4 * a * c)));
  }
};

struct WongLaw {
  static constexpr const char* kName = "wong";
  static constexpr const char* kMeaning =
      "quadratic loop, last reversal remembered (Wong, Eqs. 4.2, 4.4, 4.5)";
  static constexpr LawFamily kFamily = LawFamily::hysteretic;
  static constexpr bool kFrictionBesideB2 = true;
  static std::vector<LawParameter> parameters() {
    return law_parameter::with_fatigue({{"recovery", [](const ParameterText& t, LawParams& c) {
                                           c.reversible = t.is_second("masing", "reversible");
                                         }}});
  }

  template <class Real, int>
  static Wong<Real> make(const LawParams& c) {
    return Wong<Real>::make(c.curve, c.reversible ? Recovery::kReversible : Recovery::kMasing);
  }
};

}  // namespace hysteron
