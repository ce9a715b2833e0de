#include "sim/identification/strip.h"

#include <algorithm>
#include <cmath>

#include "sim/identification/profile.h"

namespace hysteron {
namespace {

// No point of a profile is known better than kBestAccuracy times this share of the length.
constexpr double kScale = 0.1;

// Curvature of the virgin curve at a moment >= 0.
double curvature_at(const VirginCurve& c, double moment) {
  if (moment >= c.elastic_limit_moment()) return (moment - c.friction_moment()) / c.b2;
  return 2 * moment / (c.b1 + std::sqrt(c.b1 * c.b1 + 4 * c.c1() * moment));
}

}  // namespace

std::vector<Eigen::Vector2d> hanging_strip(const VirginCurve& curve, double weight, double length,
                                           const StripEnd& end, int segments) {
  const double h = length / segments;
  std::vector<Eigen::Vector2d> points = {end.place};
  double angle = end.angle, lever = 0;  // lever: integral of x over the length beyond
  for (int i = 0; i < segments; ++i) {
    const double beyond = i * h;
    const auto bend_at = [&](double x, double length_beyond, double integral) {
      return curvature_at(curve, std::max(0.0, weight * (integral - length_beyond * x)));
    };
    const Eigen::Vector2d at = points.back();
    const double x_middle = at.x() - std::cos(angle) * h / 2;
    const double lever_middle = lever + (at.x() + x_middle) / 2 * h / 2;
    const double middle = angle + bend_at(at.x(), beyond, lever) * h / 2;
    points.push_back(at - h * Eigen::Vector2d(std::cos(middle), std::sin(middle)));
    lever += (at.x() + 4 * x_middle + points.back().x()) / 6 * h;
    angle += bend_at(x_middle, beyond + h / 2, lever_middle) * h;
  }
  std::reverse(points.begin(), points.end());
  return points;
}

StripModel::StripModel(const Profile& profile, const SmoothProfile& line, double weight,
                       const CurvePoint& start)
    : CurveModel(std::max(bend(line, 0) / line.parameters[3], 1e-6), 1),
      profile_(profile),
      weight_(weight),
      length_(line.parameters[3]),
      start_(start) {
  for (const double share : chord_shares(profile)) about_.push_back(static_cast<int>(share * kSegments));
  slope_ = start.b2 + start.g;
  const std::vector<Eigen::Vector2d> points = centre_line(line);
  const Eigen::Vector2d last = points[kSegments] - points[kSegments - 1], end = points.back() / length_;
  start_.nuisance = Eigen::Vector4d(end.x(), end.y(), std::atan2(last.y(), last.x()), 0);
}

Eigen::VectorXd StripModel::residuals(const CurvePoint& point) const {
  const Eigen::VectorXd& n = point.nuisance;
  const StripEnd end{length_ * n.head<2>(), n[2]};
  const std::vector<Eigen::Vector2d> strip =
      hanging_strip(point.curve(), weight_, length_ * std::exp(n[3]), end, kSegments);
  return distances(strip, profile_, about_) / (kScale * length_);
}

double StripModel::scatter(const CurvePoint& point) const {
  const auto n = static_cast<int>(profile_.points.size());
  return kScale * length_ * std::sqrt(residuals(point).head(n).squaredNorm() / n);
}

}  // namespace hysteron
