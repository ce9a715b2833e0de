#include "sim/mesh/random_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/mesh/delaunay.h"

namespace hysteron {
namespace {

constexpr int kRoundsEverywhere = 1;
constexpr int kRounds = 60;
constexpr double kCosLeastAngle = 0.93969262078590838;  // cos 20 degrees

double cos_angle(const Eigen::Vector2d& corner, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - corner).dot(b - corner) / std::sqrt((a - corner).squaredNorm() * (b - corner).squaredNorm());
}

// Marks the vertices of triangles with a small angle; returns whether there are any.
bool mark_sharp(const std::vector<Eigen::Vector2d>& points, const std::vector<Eigen::Vector3i>& triangles,
                std::vector<char>& sharp) {
  bool any = false;
  for (const auto& t : triangles) {
    double largest = -1;
    for (int i = 0; i < 3; ++i)
      largest = std::max(largest, cos_angle(points[t[i]], points[t[(i + 1) % 3]], points[t[(i + 2) % 3]]));
    if (largest <= kCosLeastAngle) continue;
    any = true;
    for (const int v : t) sharp[v] = 1;
  }
  return any;
}

void move_to_star_centroids(std::vector<Eigen::Vector2d>& points,
                            const std::vector<Eigen::Vector3i>& triangles, const std::vector<char>& moves) {
  std::vector<Eigen::Vector2d> moment(points.size(), Eigen::Vector2d::Zero());
  std::vector<double> area(points.size(), 0.0);
  for (const auto& t : triangles) {
    const Eigen::Vector2d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const double twice = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    for (const int v : t) moment[v] += twice / 3 * (a + b + c), area[v] += twice;
  }
  for (std::size_t v = 0; v < points.size(); ++v)
    if (moves[v]) points[v] = moment[v] / area[v];
}

}  // namespace

std::vector<Eigen::Vector3i> triangulate_relaxed(std::vector<Eigen::Vector2d>& points,
                                                 const std::vector<char>& free) {
  std::vector<Eigen::Vector3i> triangles = delaunay(points);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<char> moves(points.size(), round < kRoundsEverywhere);
    if (!mark_sharp(points, triangles, moves) && round >= kRoundsEverywhere) break;
    for (std::size_t v = 0; v < points.size(); ++v) moves[v] = moves[v] && free[v];
    move_to_star_centroids(points, triangles, moves);
    triangles = delaunay(points);
  }
  return triangles;
}

Eigen::Vector2d circle_point(int i, int n) {
  const std::int64_t quarters = 4 * static_cast<std::int64_t>(i);
  const double angle = 1.57079632679489661923 * static_cast<double>(quarters % n) / n;  // in the quadrant
  double c = 0, s = 0, term = 1;
  for (int k = 0; k < 30; k += 2) {
    c += term;
    term *= angle / (k + 1);
    s += term;
    term *= -angle / (k + 2);
  }
  const Eigen::Vector2d p = Eigen::Vector2d(c, s) / std::sqrt(c * c + s * s);
  switch (quarters / n % 4) {
    case 0:
      return p;
    case 1:
      return {-p.y(), p.x()};
    case 2:
      return -p;
    default:
      return {p.y(), -p.x()};
  }
}

}  // namespace hysteron
