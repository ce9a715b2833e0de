// Lengths of the parts of adaptive steps.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron {

inline constexpr int kMostHalvings = 12;  // of a step

// The next part after one of h, had h grown by `growth` met the tolerance: aim below it, and change slowly
// (Hairer, Norsett & Wanner 1993, II.4).
inline double next_part(double h, double growth) {
  constexpr double kAim = 0.9, kFastestGrowth = 2, kFastestFall = 0.3;
  return h * std::clamp(kAim * growth, kFastestFall, kFastestGrowth);
}

// The rest of a step in equal parts of at most `part`.
inline double equal_part(double rest, double part) { return rest / std::ceil(rest / part * (1 - 1e-9)); }

}  // namespace hysteron
