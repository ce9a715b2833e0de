#include "sim/bending/laws/recovery.h"

#include <cmath>

namespace hysteron {
namespace {

// Returns the smaller root x >= 0 of q x^2 - p x + c = 0 (p, c >= 0); infinity if there is none, where the
// straight line of slope b2 goes on.
double first_root(double q, double p, double c) {
  const double square = p * p - 4 * q * c;
  return square >= 0 ? 2 * c / (p + std::sqrt(square)) : INFINITY;
}

}  // namespace

RecoveryCase recovery_case(const VirginCurve& curve, double moment) {
  if (!(curve.friction_moment() > 0)) return RecoveryCase::elastic;  // k0 has no effect
  const Faces alike, &faces = moment < 0 ? curve.parts.faces : alike;
  const double limit = curve.friction_moment() * faces.friction + curve.b2 * faces.bending * curve.k0;
  const double m = std::abs(moment);
  return m <= limit       ? RecoveryCase::elastic
         : m <= 2 * limit ? RecoveryCase::partial
                          : RecoveryCase::full_slip;
}

bool has_residual_formula(const LawParams& law) {
  const bool elastic =
      law.name == "linear" || law.name == "bridson" || law.name == "spring" || law.name == "pabst";
  const bool friction = law.name == "bilinear" || law.name == "wong" || law.name == "prandtl";
  if (law.curve.parts.faces.on()) return false;
  const bool parts = law.name == "prandtl" && (!law.curve.parts.stops.empty() || law.curve.parts.set.on());
  return elastic || (friction && !law.fatigue.on() && !parts);
}

double residual_by_formula(const LawParams& law, double curvature, double moment) {
  const VirginCurve& c = law.curve;
  const double m0 = c.friction_moment(), g = c.b1 - c.b2, k = std::abs(curvature), m = std::abs(moment);
  if (law.name != "bilinear" && law.name != "wong" && law.name != "prandtl") return 0;
  if (!(c.k0 > 0 && g > 0)) return 0;
  const double slid = m0 / c.b2;  // where the friction of a branch that has run out holds the fold
  const auto signed_result = [&](double residual) { return curvature < 0 ? -residual : residual; };
  if (law.name == "bilinear") {
    const double unloaded = k - m * c.k0 / c.elastic_limit_moment();
    return signed_result(unloaded < k - 2 * c.k0 ? slid : unloaded);
  }
  if (law.reversible && k <= c.k0) return 0;
  const double gap = m - c.b2 * k + m0;  // F_r + M0
  const double reach = law.name == "wong" ? 2 * gap / g : 2 * c.k0;
  const double bend = law.name == "wong" ? g * g / (4 * gap) : g / (4 * c.k0);
  const double x = first_root(bend, c.b1, m);
  return signed_result(x <= reach ? k - x : slid);
}

RecoveryCounts count_recoveries(const VirginCurve& curve, const std::vector<LawRow>& rows,
                                const LawRun& run) {
  RecoveryCounts counts;
  double direction = 0, last = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double increment = rows[i].curvature - last;
    last = rows[i].curvature;
    if (increment == 0) continue;
    if (i > 0 && increment * direction < 0 && run.moment[i - 1] * direction > 0)
      ++counts.of[static_cast<int>(recovery_case(curve, run.moment[i - 1])) - 1];
    direction = increment;
  }
  return counts;
}

double residual_after(const LawRequest& request, const std::vector<LawRow>& rows) {
  LawWalk walk(request);
  for (const LawRow& row : rows) walk.to(row);
  return walk.residual();
}

}  // namespace hysteron
