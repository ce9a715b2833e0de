#include "sim/mesh/intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <numeric>

namespace hysteron {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

struct Bounds {
  Eigen::Vector3d low, high;
};

Bounds bounds_of(const Eigen::Vector3i& f, const std::vector<Eigen::Vector3d>& x) {
  return {x[f[0]].cwiseMin(x[f[1]]).cwiseMin(x[f[2]]), x[f[0]].cwiseMax(x[f[1]]).cwiseMax(x[f[2]])};
}

bool overlap(const Bounds& a, const Bounds& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

class Crossing {
 public:
  Crossing(const std::vector<Eigen::Vector3i>& face, const std::vector<Eigen::Vector3d>& position)
      : face_(face), position_(position) {}

  bool operator()(int a, int b) const {
    int shared = 0, mine = 0, theirs = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (face_[a][i] == face_[b][j]) {
          ++shared;
          mine = i;
          theirs = j;
        }
    if (shared > 1) return false;
    if (shared == 0) return CGAL::do_intersect(triangle(a), triangle(b));
    // Beyond the common corner: the side opposite to it meets the other triangle.
    return CGAL::do_intersect(opposite(a, mine), triangle(b)) ||
           CGAL::do_intersect(opposite(b, theirs), triangle(a));
  }

 private:
  Point point(int vertex) const {
    const Eigen::Vector3d& x = position_[vertex];
    return {x.x(), x.y(), x.z()};
  }
  Kernel::Triangle_3 triangle(int f) const {
    return {point(face_[f][0]), point(face_[f][1]), point(face_[f][2])};
  }
  Kernel::Segment_3 opposite(int f, int corner) const {
    return {point(face_[f][(corner + 1) % 3]), point(face_[f][(corner + 2) % 3])};
  }
  const std::vector<Eigen::Vector3i>& face_;
  const std::vector<Eigen::Vector3d>& position_;
};

// The axis along which the triangles spread farthest.
int widest_axis(const std::vector<Bounds>& bounds) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum;
  for (const Bounds& b : bounds) {
    sum += b.low;
    squares += b.low.cwiseAbs2();
  }
  const double n = static_cast<double>(bounds.size());
  int axis = 0;
  (squares / n - (sum / n).cwiseAbs2()).maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<std::pair<int, int>> intersecting_triangles(const std::vector<Eigen::Vector3i>& face,
                                                        const std::vector<Eigen::Vector3d>& position,
                                                        std::size_t most) {
  std::vector<Bounds> bounds;
  for (const auto& f : face) bounds.push_back(bounds_of(f, position));
  const int axis = widest_axis(bounds);
  std::vector<int> order(face.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return bounds[a].low[axis] < bounds[b].low[axis]; });
  const Crossing cross(face, position);
  std::vector<std::pair<int, int>> found;
  for (std::size_t i = 0; i < order.size() && found.size() < most; ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const int a = order[i], b = order[j];
      if (bounds[b].low[axis] > bounds[a].high[axis]) break;
      if (overlap(bounds[a], bounds[b]) && cross(a, b)) found.emplace_back(std::min(a, b), std::max(a, b));
    }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace hysteron
