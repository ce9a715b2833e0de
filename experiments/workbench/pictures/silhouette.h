// Measures how much of a surface's silhouette changes from one instant to another.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hysteron::experiments {

// Returns, as seen along `direction` from far away, the share of the area covered by either of two
// silhouettes that only one of them covers, which is 1 less the index of Jaccard (1912), intersection over
// union: 0 if they are equal, 1 if they are disjoint.  Both are counted in one grid of cells, a thousandth of
// the longer side of what they cover, by the cells' middles.  `before` and `now` have one position a vertex
// [m]; `direction` is not zero.
double silhouette_change(const std::vector<Eigen::Vector3i>& triangles,
                         const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& now,
                         const Eigen::Vector3d& direction);

}  // namespace hysteron::experiments
