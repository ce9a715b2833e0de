// Joining vertices that lie on each other, as exporters leave them along seams.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hysteron {

// For each point the lowest-numbered kept point closer than `distance` [m], or itself, which is then kept.
// Kept points are at least `distance` apart.  Expected time linear in the points (spatial hash).
std::vector<int> nearby_representatives(const std::vector<Eigen::Vector3d>& points, double distance);

}  // namespace hysteron
