// Rasterises triangles on a grid of cells.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace hysteron::experiments {

// Calls `take(i, j)` for each cell of a grid of this size whose middle, (i + 1/2, j + 1/2), lies in a
// triangle; for none if it is seen edge-on.  Corners are in units of cells.
template <class Take>
void for_each_cell(const std::array<Eigen::Vector2d, 3>& corner, int columns, int rows, const Take& take) {
  const auto [low, high] = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
  const int last = static_cast<int>(std::min(rows - 1.0, std::floor(high - 0.5)));
  for (int j = static_cast<int>(std::max(0.0, std::ceil(low - 0.5))); j <= last; ++j) {
    const double y = j + 0.5;
    double from = HUGE_VAL, to = -HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d &a = corner[k], &b = corner[(k + 1) % 3];
      // The ends of a level edge follow from the other two edges.
      if (a.y() == b.y() || std::min(a.y(), b.y()) > y || std::max(a.y(), b.y()) < y) continue;
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      from = std::min(from, x);
      to = std::max(to, x);
    }
    if (!(from <= to)) continue;
    const int right = static_cast<int>(std::min(columns - 1.0, std::floor(to - 0.5)));
    for (int i = static_cast<int>(std::max(0.0, std::ceil(from - 0.5))); i <= right; ++i) take(i, j);
  }
}

}  // namespace hysteron::experiments
