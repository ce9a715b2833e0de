#include "sim/mesh/intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace hysteron {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

struct Bounds {
  Eigen::Vector3d low, high;
};

Bounds triangle_bounds(const Eigen::Vector3i& f, const std::vector<Eigen::Vector3d>& x) {
  return {x[f[0]].cwiseMin(x[f[1]]).cwiseMin(x[f[2]]), x[f[0]].cwiseMax(x[f[1]]).cwiseMax(x[f[2]])};
}

bool overlap(const Bounds& a, const Bounds& b, int axis) {
  return a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis];
}

using Corners = std::array<Eigen::Vector3d, 3>;

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
    if (shared == 0)
      return !are_apart(corners(a), corners(b)) && CGAL::do_intersect(triangle(a), triangle(b));
    if (meet_only_at_their_corner(a, mine, b, theirs)) return false;
    // Triangles meet beyond their common corner if the side opposite to it meets the other triangle.
    return CGAL::do_intersect(opposite(a, mine), triangle(b)) ||
           CGAL::do_intersect(opposite(b, theirs), triangle(a));
  }

 private:
  // A plane found in plain arithmetic, with a margin far beyond its rounding, tells most pairs apart; exact
  // predicates, which take long where triangles lie almost in one plane, decide the rest.
  bool meet_only_at_their_corner(int a, int mine, int b, int theirs) const {
    const Eigen::Vector3d& corner = position_[face_[a][mine]];
    const auto side = [&](int f, int own, int k) { return position_[face_[f][(own + k) % 3]] - corner; };
    const Eigen::Vector3d a1 = side(a, mine, 1), a2 = side(a, mine, 2), b1 = side(b, theirs, 1),
                          b2 = side(b, theirs, 2);
    const Eigen::Vector3d across = (a1 + a2).normalized() - (b1 + b2).normalized();
    const double size = across.norm();
    return above({across, size}, a1) && above({across, size}, a2) && above({-across, size}, b1) &&
           above({-across, size}, b2);
  }
  static bool are_apart(const Corners& a, const Corners& b) {
    const Eigen::Vector3d middle_a = (a[0] + a[1] + a[2]) / 3, middle_b = (b[0] + b[1] + b[2]) / 3;
    const Eigen::Vector3d between = middle_a - middle_b, at = (middle_a + middle_b) / 2;
    const double size = between.norm();
    if (all_above({between, size}, at, a) && all_above({-between, size}, at, b)) return true;
    return are_beside(a, b) || are_beside(b, a);
  }
  // Is all of `other` on one side of a triangle's plane?
  static bool are_beside(const Corners& triangle, const Corners& other) {
    const Eigen::Vector3d u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], normal = u.cross(v);
    const double size = u.norm() * v.norm(), reach = u.norm() + v.norm();
    return all_above({normal, size, reach}, triangle[0], other) ||
           all_above({-normal, size, reach}, triangle[0], other);
  }
  // A plane's normal, the size that its rounding is relative to, and the farthest point in it from the
  // plane's origin [m].
  struct Side {
    Eigen::Vector3d normal;
    double size, reach = 0;
  };
  static bool all_above(const Side& side, const Eigen::Vector3d& origin, const Corners& points) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Eigen::Vector3d& x) { return above(side, x - origin); });
  }
  static bool above(const Side& side, const Eigen::Vector3d& x) {
    constexpr double kMargin = 1e-12;  // rounding is some 1e-15
    return side.normal.dot(x) > kMargin * side.size * (side.reach + x.norm());
  }
  Corners corners(int f) const {
    return {position_[face_[f][0]], position_[face_[f][1]], position_[face_[f][2]]};
  }
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

// Returns the axes in descending order of the triangles' spread.
std::array<int, 3> axes_by_spread(const std::vector<Bounds>& bounds) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum;
  for (const Bounds& b : bounds) {
    sum += b.low;
    squares += b.low.cwiseAbs2();
  }
  const double n = static_cast<double>(bounds.size());
  const Eigen::Vector3d spread = squares / n - (sum / n).cwiseAbs2();
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return spread[a] > spread[b]; });
  return axes;
}

constexpr std::size_t kMost = 1000000;

// Returns pairs whose boxes overlap and that `cross`, among those that are `asked` for.
template <class Asked>
std::vector<std::pair<int, int>> found_pairs(const std::vector<Eigen::Vector3i>& face,
                                             const std::vector<Eigen::Vector3d>& position,
                                             const Asked& asked) {
  std::vector<Bounds> bounds;
  for (const auto& f : face) bounds.push_back(triangle_bounds(f, position));
  const auto [first, second, third] = axes_by_spread(bounds);
  std::vector<int> order(face.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&, axis = first](int a, int b) { return bounds[a].low[axis] < bounds[b].low[axis]; });
  std::vector<Bounds> sorted;  // contiguous in the order of comparison
  for (const int f : order) sorted.push_back(bounds[f]);
  const Crossing cross(face, position);
  std::vector<std::pair<int, int>> found;
  for (std::size_t i = 0; i < order.size() && found.size() < kMost; ++i)
    for (std::size_t j = i + 1; j < order.size() && sorted[j].low[first] <= sorted[i].high[first]; ++j) {
      if (!overlap(sorted[i], sorted[j], second) || !overlap(sorted[i], sorted[j], third)) continue;
      const auto [a, b] = std::minmax(order[i], order[j]);
      if (asked(a, b) && cross(a, b)) found.emplace_back(a, b);
    }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<std::pair<int, int>> intersecting_triangles(const std::vector<Eigen::Vector3i>& face,
                                                        const std::vector<Eigen::Vector3d>& position) {
  return found_pairs(face, position, [](int, int) { return true; });
}

std::vector<std::pair<int, int>> crossing_triangles(const TriangleSet& first, const TriangleSet& second) {
  std::vector<Eigen::Vector3i> face = first.face;
  std::vector<Eigen::Vector3d> position = first.position;
  const int triangles = static_cast<int>(face.size()), vertices = static_cast<int>(position.size());
  for (const Eigen::Vector3i& f : second.face) face.emplace_back(f.array() + vertices);
  position.insert(position.end(), second.position.begin(), second.position.end());
  auto pairs = found_pairs(face, position, [=](int a, int b) { return a < triangles && b >= triangles; });
  for (auto& [a, b] : pairs) b -= triangles;
  return pairs;
}

std::string pairs_text(const std::vector<std::pair<int, int>>& pairs) {
  constexpr std::size_t kNamed = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(pairs.size(), kNamed); ++i)
    text += (i ? ", " : "") + std::to_string(pairs[i].first) + " and " + std::to_string(pairs[i].second);
  if (pairs.size() > kNamed) text += ", ... (" + std::to_string(pairs.size()) + " pairs in all)";
  return text;
}

}  // namespace hysteron
