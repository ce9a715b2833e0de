// Inside of the smooth centre line: shared by its fit and by what is read from it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/identification/profile.h"

namespace hysteron {

inline constexpr int kSegments = 200;  // of the centre line, equally long

// Curvature times length at t = s/L.
double bend(const SmoothProfile& line, double t);

// kSegments + 1 points from the clamp to the free end [m].
std::vector<Eigen::Vector2d> centre_line(const SmoothProfile& line);

// Share of the length up to each point, along the polygon of the points.
std::vector<double> chord_shares(const Profile& profile);

// Distances of the points from a line of kSegments, left of it positive [m]; then how far the first and the
// last point are from the line's ends, along it.  `about`: segment near which each point lies.
Eigen::VectorXd distances(const std::vector<Eigen::Vector2d>& line, const Profile& profile,
                          const std::vector<int>& about);

// Nearest smooth line with as many terms as `start` has.
SmoothProfile smooth_with(const Profile& profile, const Eigen::VectorXd& start);

}  // namespace hysteron
