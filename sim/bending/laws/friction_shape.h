// Bending friction of fabrics for which a tester printed only B and 2HB: a family of stops (bending_parts.h)
// whose shape has two numbers.
//
// Friction moments follow a lognormal distribution over the curvature at which they slip: half of HB has
// slipped at the median m, and the logarithm of the threshold has the standard deviation s (the spread).  N
// stops of equal moment HB/N stand at the quantiles
//
//   r_j = m exp(s z_j),   Phi(z_j) = (j - 1/2)/N,   p_j = HB/(N r_j),   j = 1..N
//
// s = 0 is one stop at m.  HB and b2 follow from what KES-FB2 (Kawabata 1980) reads, which is linear in both.
// Chosen here: the distribution (measured spectra fall over two decades of curvature, docs/fabrics.md) and N.
#pragma once

#include <algorithm>

#include "sim/bending/laws/bending_parts.h"

namespace hysteron {

struct FrictionShape {
  double median = 0;  // m [1/m]; 0: the fabric's friction has no such shape
  double spread = 0;  // s

  bool on() const { return median > 0; }
};

inline constexpr int kShapedStops = 8;  // laws of few stops have room for no more

// The curvatures to which the tester bends, and at which it reads.
struct KesWindow {
  double amplitude = 250;  // largest curvature [1/m]
  double slope_from = 50;  // B is the slope between these two curvatures [1/m]
  double slope_to = 150;
  double width_at = 100;  // curvature at which 2HB, the loop's width, is read [1/m]
};

struct KesPair {
  double rigidity = 0, loop_width = 0;  // B [N m], 2HB [N]
};

// Returns the pair that the tester reads on the first loop of stops beside a rigidity b2 [N m]; this is
// exact.
KesPair kes_pair(double b2, const Spectrum& stops, const KesWindow& window = {});

// Returns N stops of that shape whose friction moment is HB [N].
Spectrum shaped_stops(const FrictionShape& shape, double friction_moment);

// The stops beside b2 for which KES-FB2 reads that pair. b2 is <= 0 [N m] where such slow friction alone
// would already have a larger slope than B: such a fabric does not exist.
struct ShapedFriction {
  double b2;  // [N m]
  Spectrum stops;
};
ShapedFriction friction_from_kes(const KesPair& read, const FrictionShape& shape);

}  // namespace hysteron
