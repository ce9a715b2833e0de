// The resting phases of the crease specimen, under the load and after release: their lengths in the
// standards, the steps taken through them, and the crease that the law alone predicts.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/crease/specimen.h"
#include "experiments/specimens/cantilever_strip.h"

namespace hysteron::experiments {
namespace {

constexpr double kRounding = 1e-9;  // tolerance of times, in steps
constexpr int kParts = 4;           // parts of a step in which it is let go

// Adds equal steps of about the scene's length [s].
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

}  // namespace

CreaseParams by_standard(CreaseStandard standard) {
  constexpr double kFiveMinutes = 300, kHalfKilogram = 0.5 * 9.80665, kTenNewton = 10;
  CreaseParams choice;
  choice.standard = standard;
  choice.force = standard == CreaseStandard::aatcc66 ? kHalfKilogram : kTenNewton;
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

LawOfCrease::LawOfCrease(const Crease& crease)
    : crease_(crease),
      triangles_(crease.cloth.mesh.faces(),
                 LawWalk({crease.scene.law, curve_along(crease.scene), crease.scene.param})) {}

void LawOfCrease::bend(const std::vector<double>& along, double seconds) {
  for (std::size_t f = 0; f < triangles_.size(); ++f) triangles_[f].to({along[f], seconds});
}

void LawOfCrease::let_go(double seconds) {
  for (LawWalk& law : triangles_)
    for (int part = 0; part < kParts; ++part) law.to({law.residual(), seconds / kParts});
}

double LawOfCrease::opening() const {
  double bent = 0;
  for (std::size_t f = 0; f < triangles_.size(); ++f)
    bent += crease_.cloth.mesh.face_area[static_cast<int>(f)] * triangles_[f].residual();
  return 180 - crease_.rest_turn - bent / crease_.scene.cloth.width * 180 / std::numbers::pi;
}

void LawOfCrease::serialise(Archive& archive) {
  for (LawWalk& law : triangles_) law.serialise(archive);
}

}  // namespace hysteron::experiments
