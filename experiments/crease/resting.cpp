// Rests of the crease specimen, under the load and after release: how long the standards make them, by which
// steps they are passed, and what the law alone makes of them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/crease/specimen.h"
#include "sim/bending/laws/recovery.h"

namespace hysteron::experiments {
namespace {

constexpr double kRounding = 1e-9;  // of times, in steps
constexpr int kSteps = 40;          // of the law's way to its largest curvature
constexpr int kParts = 4;           // of a step, in which it is let go

// Equal steps as long as the scene's, or nearly.
void add_even(std::vector<double>& lengths, double seconds, double step) {
  const double count = std::max(1.0, std::round(seconds / step)), even = seconds / count;
  const bool is_step = std::abs(even - step) < kRounding * step;
  lengths.insert(lengths.end(), static_cast<std::size_t>(count), is_step ? step : even);
}

void add_growing(std::vector<double>& lengths, double seconds, double step, double grow_after) {
  for (double passed = 0; seconds - passed > kRounding * step;) {
    const double remainder = seconds - passed, grown = step * (1 + passed / grow_after);
    lengths.push_back(remainder > 2 * grown ? grown : remainder > grown ? remainder / 2 : remainder);
    passed += lengths.back();
  }
}

// Of a law bent to `size` and let go, with the rests in between: after release it is brought, several times a
// step, to where its moment was zero before.
double kept_in_time(const LawRequest& law, double size, const Crease& crease) {
  LawWalk walk(law);
  for (int k = 1; k <= kSteps; ++k) walk.to({size * k / kSteps, crease.times.folded / kSteps});
  double time = 0;
  for (const double length : crease.time_steps) {
    time += length;
    if (time <= crease.times.folded + kRounding) continue;
    if (time <= crease.times.released + kRounding) {
      walk.to({size, length});
      continue;
    }
    for (int part = 0; part < kParts; ++part) walk.to({walk.residual(), length / kParts});
  }
  return walk.residual();
}

double kept_at_once(const LawRequest& law, double size, double released) {
  std::vector<LawRow> rows;
  for (int k = 1; k <= kSteps; ++k) rows.push_back({size * k / kSteps, released / kSteps});
  return residual_after(law, rows);
}

}  // namespace

CreaseChoice by_standard(const std::string& standard) {
  constexpr double kFiveMinutes = 300, kHalfKilogram = 0.5 * 9.80665, kTenNewton = 10;
  CreaseChoice choice;
  choice.standard = standard;
  choice.force = standard == "aatcc66" ? kHalfKilogram : kTenNewton;
  choice.hold = choice.recovery = kFiveMinutes;
  choice.grow_after = 1.0 / 30;
  return choice;
}

std::vector<double> growing_steps(const CreaseTimes& times, double step, double grow_after) {
  std::vector<double> lengths;
  add_even(lengths, times.pressed, step);
  add_growing(lengths, times.released - times.pressed, step, grow_after);
  if (times.lifted > times.released) add_even(lengths, times.lifted - times.released, step);
  add_growing(lengths, times.end - times.lifted, step, grow_after);
  return lengths;
}

double Crease::opening_of_law(const std::vector<double>& largest) const {
  const LawRequest law{scene.law, scene.fabric.virgin_curve(), scene.param};
  double bent = 0;
  for (int f = 0; f < cloth.mesh.faces(); ++f) {
    const double size = std::abs(largest[f]);
    if (size == 0) continue;
    const double kept =
        time_steps.empty() ? kept_at_once(law, size, times.released) : kept_in_time(law, size, *this);
    bent += std::copysign(cloth.mesh.face_area[f], largest[f]) * kept;
  }
  return 180 - rest_turn - bent / scene.cloth.width * 180 / std::numbers::pi;
}

}  // namespace hysteron::experiments
