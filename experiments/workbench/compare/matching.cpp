#include "experiments/workbench/compare/matching.h"

#include <cmath>

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

constexpr int kSteps = 2000;          // steps to the curvature
constexpr double kAlmostFlat = 1e-6;  // share of k0 at which the slope at rest is taken
constexpr double kExact = 1e-9;       // relative tolerance
constexpr int kMaxIterations = 60;

// Returns the slope of the moment at rest [N m].
double initial_stiffness(const LawRequest& law, double side) {
  const double flat = side * kAlmostFlat * law.curve.k0;
  return run_law(law, {{0, 0}, {flat, 1e-6}}).moment.back() / flat;
}

double measure(LawRequest law, double scale, Match match, double curvature) {
  law.curve.b1 *= scale;
  law.curve.b2 *= scale;
  law.curve.parts = stiffened(law.curve.parts, scale);
  const auto to_side = [&](double side) {  // 1 for the face, -1 for the back
    return match == Match::energy ? bending_work(law, side * curvature) : initial_stiffness(law, side);
  };
  return law.curve.parts.faces.on() ? (to_side(1) + to_side(-1)) / 2 : to_side(1);
}

}  // namespace

BendingParts stiffened(BendingParts parts, double scale) {
  for (auto* stiffnesses :
       {&parts.stops.stiffnesses, &parts.weft_stops.stiffnesses, &parts.branches.stiffnesses})
    for (double& p : *stiffnesses) p *= scale;
  parts.set.hardening *= scale;
  return parts;
}

double bending_work(const LawRequest& law, double curvature) {
  std::vector<LawRow> rows(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) rows[i] = {curvature * i / kSteps, i == 0 ? 0.0 : 1.0 / kSteps};
  const LawRun run = run_law(law, rows);
  double work = 0;
  for (int i = 0; i < kSteps; ++i) work += (run.moment[i] + run.moment[i + 1]) / 2 * curvature / kSteps;
  return work;
}

// Moments of nearly all laws are proportional to b1 and b2; then the first step is exact.
double matching_scale(const LawRequest& law, const LawRequest& reference, Match match, double curvature) {
  if (match == Match::fabric) return 1;
  const double wanted = measure(reference, 1, match, curvature);
  double scale = 1;
  for (int k = 0; k < kMaxIterations; ++k) {
    const double found = measure(law, scale, match, curvature);
    if (std::abs(found / wanted - 1) <= kExact) return scale;
    scale *= wanted / found;
    if (!(scale > 0) || !std::isfinite(scale)) break;
  }
  throw Error::invalid_input("law " + law.name + " cannot be made as stiff as " + reference.name +
                             " by scaling its stiffnesses")
      .with_key("law", law.name);
}

}  // namespace hysteron::experiments
