// Bending hysteresis with exact memory of reversals: this is the Prandtl-Ishlinskii law on a scalar
// curvature.
//
// M = b2 K + F.  With g = b1 - b2 and x the curvature travelled since the branch began:
//   virgin            |F| = g x - g x^2/(2 K0),             x <= K0     (Wong, Eq. 4.2)
//   after a reversal  F = F_r + s (g x - g x^2/(4 K0)),     x <= 2 K0   (Wong, Eqs. 4.4, 4.5; Masing's
//   doubling)
// and F = s M0 where the branch has run out.  A branch that comes back to the reversal before it closes a
// loop: both points are forgotten and the enclosing branch goes on; the mirror image of the first reversal
// leads back to the virgin curve.  This is the limit of infinitely many stops (Whiteman 1959, Iwan 1966).
//
// The stack is bounded: when a reversal finds it full, the innermost pair is dropped and counted.  With three
// or more points a branch ends where its moment meets the enclosing branch of the same direction, which
// without drops is the reversal point itself, and with drops keeps M continuous.
//
// Energies: at distance x the stops with r < x/2 slip, hence the branch dissipates g x^3/(24 K0) (virgin
// g x^3/(6 K0)), then M0 per curvature; friction energy = work - loss, kept at every reversal.  All stops
// slipping hold M0 K0/3.  Once a pair was dropped, joining the enclosing branch books the difference of the
// two friction energies as dissipated too, which may be negative (seen: -0.04 M0 K0, at depths 4
// and 8 alike); the balance of work stays exact.  Chosen here, not in the chapter (it breaks off before
// partial reversals): all of the memory.  K0 = 0 or b1 = b2 leave M = b2 K.
#pragma once

#include <cmath>

#include "sim/bending/laws/law.h"

namespace hysteron {

template <class Real, int Depth>
struct PrandtlStack {
  static_assert(Depth >= 4, "two outermost points stay exact only if a pair can be dropped above them");
  static constexpr int kDimension = 1;
  static constexpr int kHistory = 5 + 3 * Depth;
  using Scalar = Real;
  using Memory = History<Real, kHistory>;

  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real g = 0;   // friction stiffness b1 - b2 [N m]
  Real k0 = 0;  // elastic limit [1/m]
  Real m0 = 0;  // friction moment [N]

  static PrandtlStack make(const VirginCurve& curve) {
    const bool friction = curve.k0 > 0 && curve.b1 > curve.b2;
    if (!friction) return {Real(curve.b2), 0, 0, 0};
    return {Real(curve.b2), Real(curve.b1 - curve.b2), Real(curve.k0), Real(curve.friction_moment())};
  }

  HYST_HD LawStep<Real, 1, kHistory> step(const Vec<Real, 1>& curvature, const Memory& before) const {
    LawStep<Real, 1, kHistory> result;
    result.history = before;
    result.dissipated = travel(curvature[0], result.history);
    const Branch branch = active_branch(result.history);
    const Real x = branch.position(curvature[0]);
    result.moment[0] = b2 * curvature[0] + friction(branch, x);
    result.stored = b2 * curvature[0] * curvature[0] / 2 + friction_energy(branch, x);
    return result;
  }

  HYST_HD Tangent<Real, 1> tangent(const Vec<Real, 1>& curvature, const Memory& before) const {
    Memory after = before;
    travel(curvature[0], after);
    const Branch branch = active_branch(after);
    const Real x = branch.position(curvature[0]);
    return Tangent<Real, 1>(b2 + (x < branch.reach ? g - 2 * branch.bend * x : Real(0)));
  }

  // Walks the branches that unloading follows and returns the root on the one where the moment vanishes.
  HYST_HD Vec<Real, 1> residual(const Memory& history) const {
    Memory memory = history;
    const Branch current = active_branch(memory);
    const Real moment = b2 * memory[kCurvature] + friction(current, current.position(memory[kCurvature]));
    if (moment == 0) return Vec<Real, 1>(memory[kCurvature]);
    turn_towards(moment > 0 ? Real(-1) : Real(1), memory);
    for (;;) {
      const Branch branch = active_branch(memory);
      const Real x = root(branch), end = branch_end(branch, memory);
      if (runs_out(memory) || x <= end) return Vec<Real, 1>(branch.start.curvature + branch.direction * x);
      leave(branch, end, memory);
    }
  }
  HYST_HD Real largest_stiffness() const { return b2 + g; }

  // Returns how many pairs of reversals were dropped because the stack was full; 0 means that the memory is
  // exact.
  HYST_HD static int dropped_pairs(const Memory& history) { return int(history[kDropped]); }

 private:
  // The history holds the present curvature, the last direction (0 at rest), the number of reversals kept,
  // whether the first of them stands for full slip (otherwise it lies on the virgin curve), the pairs
  // dropped, and then the reversals.
  enum Slot { kCurvature, kDirection, kCount, kSlippedThrough, kDropped, kTurns };

  struct Turn {
    Real curvature, friction, energy;  // [1/m], [N], [J/m^2]
  };
  struct Branch {
    Turn start;
    Real direction;
    Real reach;  // x at which F = s M0 [1/m]
    Real bend;   // F = F_r + s (g x - bend x^2) [N m^2]
    Real loss;   // dissipated: loss x^3 [N m^2]
    HYST_HD Real position(Real curvature) const { return direction * (curvature - start.curvature); }
  };

  HYST_HD static int count(const Memory& m) { return int(m[kCount]); }
  HYST_HD static Turn turn(const Memory& m, int i) {
    return {m[kTurns + 3 * i], m[kTurns + 3 * i + 1], m[kTurns + 3 * i + 2]};
  }
  HYST_HD static void put(Memory& m, int i, const Turn& t) {
    m[kTurns + 3 * i] = t.curvature, m[kTurns + 3 * i + 1] = t.friction, m[kTurns + 3 * i + 2] = t.energy;
  }

  HYST_HD Branch active_branch(const Memory& m) const {
    const Real bend = k0 > 0 ? g / (4 * k0) : Real(0);
    if (count(m) == 0) return {{0, 0, 0}, m[kDirection], k0, 2 * bend, 2 * bend / 3};
    return {turn(m, count(m) - 1), m[kDirection], 2 * k0, bend, bend / 6};
  }
  HYST_HD Real friction(const Branch& b, Real x) const {
    const Real bent = x < b.reach ? x : b.reach;
    return b.start.friction + b.direction * bent * (g - b.bend * bent);
  }
  HYST_HD Real loss(const Branch& b, Real x) const {
    const Real bent = x < b.reach ? x : b.reach;
    return b.loss * bent * bent * bent + m0 * (x - bent);
  }
  HYST_HD Real friction_energy(const Branch& b, Real x) const {
    const Real bent = x < b.reach ? x : b.reach;
    const Real work = b.direction * b.start.friction * x + bent * bent * (g / 2 - b.bend * bent / 3) +
                      (x - bent) * bent * (g - b.bend * bent);
    return b.start.energy + work - loss(b, x);
  }

  // Moves to `curvature` and returns what is dissipated on the way [J/m^2].
  HYST_HD Real travel(Real curvature, Memory& m) const {
    const Real increment = curvature - m[kCurvature];
    if (increment == 0) return 0;
    turn_towards(increment > 0 ? Real(1) : Real(-1), m);
    Real dissipated = 0, at = m[kCurvature];
    for (;;) {
      const Branch branch = active_branch(m);
      const Real from = branch.position(at), to = branch.position(curvature);
      const Real end = runs_out(m) ? to : branch_end(branch, m);
      if (runs_out(m) || to < end) {
        dissipated += loss(branch, to) - loss(branch, from);
        m[kCurvature] = curvature;
        if (to > branch.reach) slip_through(branch.direction, curvature, m);
        return dissipated;
      }
      const Real last = end > from ? end : from;
      dissipated += loss(branch, last) - loss(branch, from);
      at = leave(branch, last, m);
      if (dropped_pairs(m) > 0) dissipated += friction_energy(branch, last) - energy_at(at, m);
    }
  }
  HYST_HD Real energy_at(Real curvature, const Memory& m) const {
    const Branch branch = active_branch(m);
    return friction_energy(branch, branch.position(curvature));
  }

  HYST_HD void turn_towards(Real direction, Memory& m) const {
    if (direction * m[kDirection] < 0) {
      const Branch branch = active_branch(m);
      const Real x = branch.position(m[kCurvature]);
      if (count(m) == Depth) m[kCount] -= 2, m[kDropped] += 1;
      put(m, count(m), {m[kCurvature], friction(branch, x), friction_energy(branch, x)});
      m[kCount] += 1;
    }
    m[kDirection] = direction;
  }

  // Sets full slip in direction s, as if the branch had begun 2 K0 before, with all stops slipping along -s.
  HYST_HD void slip_through(Real s, Real curvature, Memory& m) const {
    put(m, 0, {curvature - s * 2 * k0, -s * m0, m0 * k0 / 3});
    m[kCount] = 1, m[kSlippedThrough] = 1;
  }
  HYST_HD static bool runs_out(const Memory& m) { return count(m) == 1 && m[kSlippedThrough] != 0; }

  // Returns the position at which the branch ends and another one begins.
  HYST_HD Real branch_end(const Branch& b, const Memory& m) const {
    using std::abs;
    const int n = count(m);
    if (n == 0) return b.reach;
    if (n == 1) return 2 * abs(b.start.curvature);
    const Real back = abs(turn(m, n - 2).curvature - b.start.curvature);
    if (n == 2) return back < b.reach ? back : b.reach;
    return meeting(b, turn(m, n - 3), back);
  }

  // Returns where branch b meets the branch of the same direction from `outer`; `back` if they coincide.
  HYST_HD Real meeting(const Branch& b, const Turn& outer, Real back) const {
    using std::sqrt;
    const Real ahead = b.direction * (b.start.curvature - outer.curvature);
    const Real rise = b.direction * (b.start.friction - outer.friction);
    if (!(b.bend * ahead > 0)) return back;
    const Real x = (g * ahead - b.bend * ahead * ahead - rise) / (2 * b.bend * ahead);
    if (x + ahead <= b.reach) return x;
    return rise > 0 ? b.reach * (1 - sqrt(rise / (2 * m0))) : b.reach;
  }

  // Closes the loop that ends at position `end` and returns the curvature there.
  HYST_HD Real leave(const Branch& b, Real end, Memory& m) const {
    const Real at = b.start.curvature + b.direction * end;
    const bool full_slip = count(m) == 0 || (count(m) == 2 && m[kSlippedThrough] != 0);
    if (full_slip)
      slip_through(b.direction, at, m);
    else
      m[kCount] = count(m) <= 2 ? Real(0) : m[kCount] - 2;
    return at;
  }

  // Returns the position at which b2 K + F = 0 on this branch, or beyond its reach on the straight line that
  // follows.
  HYST_HD Real root(const Branch& b) const {
    using std::sqrt;
    const Real c = -b.direction * (b2 * b.start.curvature + b.start.friction);
    const Real b1 = b2 + g, square = b1 * b1 - 4 * b.bend * c;
    const Real x = square >= 0 ? 2 * c / (b1 + sqrt(square)) : 2 * b.reach;
    if (x <= b.reach || b2 == 0) return x;
    return (c - b.reach * (g - b.bend * b.reach)) / b2;
  }
};

}  // namespace hysteron
