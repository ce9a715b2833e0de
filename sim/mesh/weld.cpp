#include "sim/mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace hysteron {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 32);
  }
};

// Kept points by cell.  Cells are at least `distance` wide, so that the 27 cells around a point hold all
// that are near it.
class Grid {
 public:
  Grid(const std::vector<Eigen::Vector3d>& points, double distance) : points_(points), distance_(distance) {
    double extent = 0;
    for (const auto& p : points) extent = std::max(extent, p.cwiseAbs().maxCoeff());
    width_ = std::max(distance, 1e-12 * extent);  // keeps cell numbers within 64 bits
  }

  void keep(int i) { kept_[cell(points_[i])].push_back(i); }

  // The lowest-numbered kept point near point i, or i.
  int nearby(int i) const {
    const Cell centre = cell(points_[i]);
    int lowest = i;
    for (int k = 0; k < 27; ++k) {
      const auto found =
          kept_.find({centre[0] + k % 3 - 1, centre[1] + k / 3 % 3 - 1, centre[2] + k / 9 - 1});
      if (found == kept_.end()) continue;
      for (const int j : found->second)
        if (j < lowest && (points_[j] - points_[i]).norm() < distance_) lowest = j;
    }
    return lowest;
  }

 private:
  Cell cell(const Eigen::Vector3d& p) const {
    const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / width_)); };
    return {index(p.x()), index(p.y()), index(p.z())};
  }

  const std::vector<Eigen::Vector3d>& points_;
  double distance_, width_;
  std::unordered_map<Cell, std::vector<int>, CellHash> kept_;
};

}  // namespace

std::vector<int> nearby_representatives(const std::vector<Eigen::Vector3d>& points, double distance) {
  Grid grid(points, distance);
  std::vector<int> representative;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    representative.push_back(grid.nearby(i));
    if (representative.back() == i) grid.keep(i);
  }
  return representative;
}

}  // namespace hysteron
