// Gives the fall of a swing's amplitude by the chapter's friction, in closed form: one mode whose curvature
// bends to and fro by A, with the virgin curve of b1, b2, k0 (Wong, Eq. 4.2) and friction moment M0.
//
//   loss in a cycle       D = 4 M0 (A - 2 k0/3)            A >= k0: friction is saturated
//                         D = 4/3 |c1| A^3                 A <= k0, |c1| = M0/k0^2: loops on the parabola
//   stored at a turn      dE/dA = k A                      A >= k0
//                         dE/dA = k A + (b1 - b2) A (1 - A/k0)   A <= k0 (Masing 1926)
//
// with k the stiffness beside friction, b2 and weight.  From dE/dA dA/dn = -D and a constant period follows,
// with x = A/k0, tau = t b/k0, b the speed at which saturated friction takes amplitude, and s = (k + b1 -
// b2)/k, by how much friction that has not slipped stiffens the mode,
//
//   x >= 1:  dx/dtau = -(1 - 2/(3 x))                   tau = G(x0) - G(x),   G = x + 2/3 ln(x - 2/3)
//   x <= 1:  dx/dtau = -x^2/(3 (s - (s - 1) x))         tau = 3 (H(x) - H(x0)),   H = s/x + (s - 1) ln x.
//
// Amplitudes are those of any length that goes with the curvature, here of the free end.  It has four
// numbers: first amplitude, b, knee, s.  Its limits are a line for knee -> 0, a hyperbola for a knee above
// the first amplitude and s = 1.  A strip's curvature varies along it and so does the place where friction
// has saturated, and its period grows by sqrt(s) above the knee: both are left to the fitted b and s, which
// are thereby effective numbers.  For a simulated strip of cotton with k0 = 8/m its rms error is 0.2 % of the
// first amplitude.
#pragma once

#include <vector>

namespace hysteron {

struct SaturatingDecay {
  double first = 0;       // amplitude at t = 0 [m]
  double rate = 0;        // b: fall of amplitudes far above the knee [m/s]
  double knee = 0;        // amplitude at which friction saturates [m]
  double stiffening = 1;  // s >= 1: stiffness at the smallest amplitudes over that of saturated friction

  double at(double time) const;            // amplitude [m]; time >= 0 [s]
  double time_to(double amplitude) const;  // the inverse [s], for 0 < amplitude <= first
};

// Fits at least six amplitudes [m] by least squares, at times [s] that rise from 0.
SaturatingDecay fit_saturating_decay(const std::vector<double>& time, const std::vector<double>& amplitude);

}  // namespace hysteron
