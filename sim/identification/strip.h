// A strip that sags from a clamp under its own weight, as a function of its virgin curve.
#pragma once

#include "sim/identification/model.h"
#include "sim/identification/profile.h"

namespace hysteron {

// Where a strip's free end is.
struct StripEnd {
  Eigen::Vector2d place;  // [m]
  double angle = 0;       // of the strip there [rad]
};

// Centre line from the clamp to the free end: segments + 1 points at equal distances [m].  `weight` per area
// [N/m^2].  Loading only: every curvature grew from zero (midpoint rule from the free end, where K = 0).
std::vector<Eigen::Vector2d> hanging_strip(const VirginCurve& curve, double weight, double length,
                                           const StripEnd& end, int segments);

// Nuisance: place of the free end and logarithm of the length, over the length of the smooth line; its angle.
class StripModel : public CurveModel {
 public:
  StripModel(const Profile& profile, const SmoothProfile& line, double weight, const CurvePoint& start);

  // Distances of the points from the strip over a tenth of its length.
  Eigen::VectorXd residuals(const CurvePoint& point) const override;
  CurvePoint start() const override { return start_; }
  // Root mean square distance of the points [m].
  double scatter(const CurvePoint& point) const;

 private:
  Profile profile_;
  std::vector<int> about_;  // segment near which each point lies
  double weight_, length_;
  CurvePoint start_;
};

}  // namespace hysteron
