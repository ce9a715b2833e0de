#include "experiments/workbench/pictures/silhouette.h"

#include <Eigen/Geometry>
#include <array>

#include "experiments/workbench/pictures/raster.h"

namespace hysteron::experiments {
namespace {

constexpr double kCells = 1000;  // number along the longer side

using Points = std::vector<Eigen::Vector2d>;

Points seen_along(const std::vector<Eigen::Vector3d>& x, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = direction.normalized(), right = d.unitOrthogonal(), up = d.cross(right);
  Points points;
  for (const Eigen::Vector3d& p : x) points.push_back({right.dot(p), up.dot(p)});
  return points;
}

}  // namespace

double silhouette_change(const std::vector<Eigen::Vector3i>& triangles,
                         const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& now,
                         const Eigen::Vector3d& direction) {
  const Points points[] = {seen_along(before, direction), seen_along(now, direction)};
  Eigen::AlignedBox2d box;
  for (const Points& of : points)
    for (const Eigen::Vector3i& t : triangles)
      for (int k = 0; k < 3; ++k) box.extend(of[t[k]]);
  const double cell = box.isEmpty() ? 0 : box.sizes().maxCoeff() / kCells;
  if (!(cell > 0)) return 0;
  const auto count = [&](int axis) { return 1 + static_cast<int>(box.sizes()[axis] / cell); };
  const int columns = count(0), rows = count(1);
  std::array<std::vector<char>, 2> covered;
  for (int side = 0; side < 2; ++side) {
    covered[side].assign(static_cast<std::size_t>(columns) * rows, 0);
    for (const Eigen::Vector3i& t : triangles) {
      const auto at = [&](int v) -> Eigen::Vector2d { return (points[side][v] - box.min()) / cell; };
      for_each_cell({at(t[0]), at(t[1]), at(t[2])}, columns, rows,
                    [&](int i, int j) { covered[side][static_cast<std::size_t>(j) * columns + i] = 1; });
    }
  }
  long both = 0, either = 0;
  for (std::size_t i = 0; i < covered[0].size(); ++i) {
    both += covered[0][i] && covered[1][i];
    either += covered[0][i] || covered[1][i];
  }
  return either > 0 ? 1 - static_cast<double>(both) / static_cast<double>(either) : 0;
}

}  // namespace hysteron::experiments
