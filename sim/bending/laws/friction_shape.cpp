#include "sim/bending/laws/friction_shape.h"

#include <cmath>

namespace hysteron {
namespace {

// The z of Phi(z) = 9/16, 11/16, 13/16, 15/16, the upper half of the quantiles.
constexpr double kNormal[] = {0.15731068461017067, 0.4887764111146694, 0.8871465590188758,
                              1.5341205443525459};
static_assert(2 * std::size(kNormal) == kShapedStops);

}  // namespace

KesPair kes_pair(double b2, const Spectrum& stops, const KesWindow& w) {
  const auto friction = [&](double k) { return stops.friction_at(k); };
  const double a = w.amplitude, at = w.width_at;
  // Friction rises by `up` on the virgin curve, and by `down` on the branch after the reversal, which is that
  // curve doubled.
  const double up = friction(w.slope_to) - friction(w.slope_from);
  const double down = 2 * (friction((a + w.slope_to) / 2) - friction((a + w.slope_from) / 2));
  const double width =
      (friction(at) - 3 * friction(a) + 4 * friction((a - at) / 2) + 2 * friction((a + at) / 2)) / 2;
  return {b2 + (up + down) / 2 / (w.slope_to - w.slope_from), width};
}

Spectrum shaped_stops(const FrictionShape& shape, double friction_moment) {
  Spectrum stops;
  const int half = kShapedStops / 2;
  for (int j = 0; j < kShapedStops; ++j) {
    const double z = j < half ? -kNormal[half - 1 - j] : kNormal[j - half];
    const double threshold = shape.median * std::exp(shape.spread * z);
    stops.thresholds.push_back(threshold);
    stops.stiffnesses.push_back(friction_moment / kShapedStops / threshold);
  }
  return stops;
}

ShapedFriction friction_from_kes(const KesPair& read, const FrictionShape& shape) {
  const KesPair unit = kes_pair(0, shaped_stops(shape, 1));
  const double friction_moment = read.loop_width / unit.loop_width;
  return {read.rigidity - friction_moment * unit.rigidity, shaped_stops(shape, friction_moment)};
}

}  // namespace hysteron
