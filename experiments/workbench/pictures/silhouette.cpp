#include "experiments/workbench/pictures/silhouette.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hysteron::experiments {
namespace {

constexpr double kCells = 1000;  // along the longer side

using Points = std::vector<Eigen::Vector2d>;

Points seen_along(const std::vector<Eigen::Vector3d>& x, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = direction.normalized(), right = d.unitOrthogonal(), up = d.cross(right);
  Points points;
  for (const Eigen::Vector3d& p : x) points.push_back({right.dot(p), up.dot(p)});
  return points;
}

// Cells of one side; cell (i, j) has its middle at (i + 1/2, j + 1/2).
struct Grid {
  int columns, rows;
  std::vector<char> covered;

  Grid(int columns, int rows)
      : columns(columns), rows(rows), covered(static_cast<std::size_t>(columns) * rows) {}

  // Those whose middles lie in a triangle, whose corners are in units of cells; none of one seen edge on.
  void cover(const std::array<Eigen::Vector2d, 3>& corner) {
    const auto [low, high] = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
    const int last = std::min(rows - 1, static_cast<int>(std::floor(high - 0.5)));
    for (int j = std::max(0, static_cast<int>(std::ceil(low - 0.5))); j <= last; ++j) {
      const auto [from, to] = crossed(corner, j + 0.5);
      const int right = std::min(columns - 1, static_cast<int>(std::floor(to - 0.5)));
      for (int i = std::max(0, static_cast<int>(std::ceil(from - 0.5))); i <= right; ++i)
        covered[static_cast<std::size_t>(j) * columns + i] = 1;
    }
  }

  // From where to where a triangle reaches at this height.
  static std::pair<double, double> crossed(const std::array<Eigen::Vector2d, 3>& corner, double y) {
    double from = HUGE_VAL, to = -HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d &a = corner[k], &b = corner[(k + 1) % 3];
      // The other two edges tell where a level one ends.
      if (a.y() == b.y() || std::min(a.y(), b.y()) > y || std::max(a.y(), b.y()) < y) continue;
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      from = std::min(from, x);
      to = std::max(to, x);
    }
    return {from, to};
  }
};

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
  const auto count = [&](int side) { return 1 + static_cast<int>(box.sizes()[side] / cell); };
  Grid first(count(0), count(1)), second = first;
  for (Grid* grid : {&first, &second}) {
    const Points& of = points[grid == &second];
    for (const Eigen::Vector3i& t : triangles) {
      const auto at = [&](int v) -> Eigen::Vector2d { return (of[v] - box.min()) / cell; };
      grid->cover({at(t[0]), at(t[1]), at(t[2])});
    }
  }
  long both = 0, either = 0;
  for (std::size_t i = 0; i < first.covered.size(); ++i) {
    both += first.covered[i] && second.covered[i];
    either += first.covered[i] || second.covered[i];
  }
  return either > 0 ? 1 - static_cast<double>(both) / static_cast<double>(either) : 0;
}

}  // namespace hysteron::experiments
