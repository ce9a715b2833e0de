// Moment and curvature from the profile of a sagging cantilever (Clapp, Peng, Ghosh & Eischen 1990, "Indirect
// measurement of the moment-curvature relationship for fabrics", Textile Research Journal 60(9)).
//
//      clamp                      y up, gravity down; s along the strip, 0 at the clamp, L at the free end
//   =====o----.                   M(s) = w int_s^L (x(t) - x(s)) dt     w: weight per area
//             `-.                 K(s) = -d(slope angle)/ds
//                `\.
//                  \  s = L
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/identification/identification.h"
#include "sim/identification/model.h"

namespace hysteron {

struct Profile {
  std::string name;                     // of the file, without its folder
  std::vector<Eigen::Vector2d> points;  // centre line from the clamp to the free end [m]
};

// Columns `x [m]`, `y [m]`.  Throws Error::system, and Error::invalid_input for fewer than 12 points, points
// that go back (a cantilever under its own weight runs on or down), an end that is not below the clamp, and
// lengths that no test has.
Profile read_profile(const std::filesystem::path& file, const std::string& reader);

// A smooth centre line: its curvature is a polynomial that is zero at the free end with its slope, as moment
// and shear are: K L = (1 - s/L)^2 sum_j c_j T_j(2 s/L - 1), T_j of Chebyshev.
struct SmoothProfile {
  Eigen::VectorXd parameters;  // x, y [m], angle [rad] at the clamp, length [m], c_0, c_1, ...
  double scatter = 0;          // standard deviation of the points across the line [m]
  int iterations = 0;

  int terms() const { return static_cast<int>(parameters.size()) - 4; }
};

// With as many terms as Akaike's criterion (1974) asks for.
SmoothProfile smooth(const Profile& profile);

struct MomentTable {
  std::vector<double> curvature, moment;  // from the free end to the clamp [1/m], [N]
};
// `weight` per area [N/m^2].
MomentTable moment_table(const SmoothProfile& line, double weight);

// The virgin curve: first through that table, then, because a smooth line rounds bends off and its errors
// hang together, so that a strip with this virgin curve hangs nearest to the points.  Data and residuals are
// the table's.  Throws Error::invalid_input if the profile does not bend down, or shows a stiffness that no
// fabric has.
Identification identify_profile(const Profile& profile, double density, const Assumptions& assumptions);

// Inside of the smooth centre line: shared by its fit and by what is read from it.

inline constexpr int kSegments = 200;  // of the centre line, equally long

// Curvature times length at t = s/L.
double bend(const SmoothProfile& line, double t);

// kSegments + 1 points from the clamp to the free end [m].
std::vector<Eigen::Vector2d> centre_line(const SmoothProfile& line);

// Share of the length up to each point, along the polygon of the points.
std::vector<double> chord_fractions(const Profile& profile);

// Distances of the points from a line of kSegments, left of it positive [m]; then how far the first and the
// last point are from the line's ends, along it.  `about`: segment near which each point lies.
Eigen::VectorXd distances(const std::vector<Eigen::Vector2d>& line, const Profile& profile,
                          const std::vector<int>& about);

// Nearest smooth line with as many terms as `start` has.
SmoothProfile smooth_with(const Profile& profile, const Eigen::VectorXd& start);

// A strip that sags from a clamp under its own weight, as a function of its virgin curve.

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
