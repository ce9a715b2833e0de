// Sorts points into the cells of a grid, to find those near a place in expected constant time.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hysteron {

class PointGrid {
 public:
  // Cells are at least `width` [m] wide, so that the 27 cells around a place hold all points that are nearer
  // than that.
  PointGrid(const std::vector<Eigen::Vector3d>& points, double width) {
    double extent = 0;
    for (const auto& p : points) extent = std::max(extent, p.cwiseAbs().maxCoeff());
    width_ = std::max(width, 1e-12 * extent);  // keeps cell numbers within 64 bits
  }

  double width() const { return width_; }
  void add(int i, const Eigen::Vector3d& at) { kept_[cell(at)].push_back(i); }

  // Calls visit(i) for all points in the 27 cells around a place.
  template <class Visit>
  void around(const Eigen::Vector3d& at, const Visit& visit) const {
    const Cell centre = cell(at);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          kept_.find({centre[0] + k % 3 - 1, centre[1] + k / 3 % 3 - 1, centre[2] + k / 9 - 1});
      if (found == kept_.end()) continue;
      for (const int i : found->second) visit(i);
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t hash = 0;
      for (const std::int64_t c : cell) hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15u;
      return hash ^ (hash >> 32);
    }
  };

  Cell cell(const Eigen::Vector3d& p) const {
    const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / width_)); };
    return {index(p.x()), index(p.y()), index(p.z())};
  }

  double width_;
  std::unordered_map<Cell, std::vector<int>, CellHash> kept_;
};

}  // namespace hysteron
