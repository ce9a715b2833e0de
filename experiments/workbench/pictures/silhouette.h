// Silhouettes of a surface: how much of what is seen of it changes from one instant to another.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hysteron::experiments {

// Seen along `direction` from far away: share of the area that two silhouettes of the triangles cover
// together which only one of them covers, 1 less the index of Jaccard (1912), intersection over union; 0
// where they are alike, 1 where they are apart.  Both are counted in one grid of cells, a thousandth of the
// longer side of what they cover, by the cells' middles.  `before` and `now` have one position a vertex [m];
// `direction` is not zero.
double silhouette_change(const std::vector<Eigen::Vector3i>& triangles,
                         const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& now,
                         const Eigen::Vector3d& direction);

}  // namespace hysteron::experiments
