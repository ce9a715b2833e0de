#include "sim/mesh/delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/mesh/random_points.h"

namespace hysteron {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Centre of the circle through the corners: c = p0 + (|u|^2 v - |v|^2 u) turned clockwise / (2 u x v).
Eigen::Vector2d circle_centre(const Points& p, const Eigen::Vector3i& t) {
  const Eigen::Vector2d u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]];
  const Eigen::Vector2d w = u.squaredNorm() * v - v.squaredNorm() * u;
  return p[t[0]] + Eigen::Vector2d(w.y(), -w.x()) / (2 * cross(u, v));
}

Points random_square(int n) {
  Uniform uniform(11);
  Points points;
  for (int i = 0; i < n; ++i) {
    const double x = uniform(0, 1), y = uniform(0, 1);
    points.emplace_back(x, y);
  }
  return points;
}

double area(const Points& p, const std::vector<Eigen::Vector3i>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += 0.5 * cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  return sum;
}

TEST(Delaunay, NoCircleThroughATriangleHoldsAnotherPoint) {
  const Points points = random_square(400);
  for (const auto& t : delaunay(points)) {
    const Eigen::Vector2d centre = circle_centre(points, t);
    const double radius = (points[t[0]] - centre).norm();
    ASSERT_NEAR((points[t[1]] - centre).norm(), radius, 1e-9 * radius);
    for (const auto& p : points) EXPECT_GT((p - centre).norm(), radius * (1 - 1e-7));  // the grid's rounding
  }
}

TEST(Delaunay, TrianglesAreCounterClockwiseAndFillTheConvexHull) {
  Points points = random_square(1000);
  points.insert(points.end(), {{-1, -1}, {2, -1}, {2, 2}, {-1, 2}});
  const auto triangles = delaunay(points);
  for (const auto& t : triangles)
    EXPECT_GT(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]), 0);
  EXPECT_NEAR(area(points, triangles), 9, 1e-12);
  EXPECT_EQ(triangles.size(), 2 * points.size() - 4 - 2);  // 2 n - hull - 2
}

TEST(Delaunay, LatticeWithFourPointsOnEveryCircleIsFilledOnce) {
  Points points;
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 20; ++j) points.emplace_back(i, j);
  const auto triangles = delaunay(points);
  EXPECT_EQ(triangles.size(), 2u * 30 * 20);
  for (const auto& t : triangles)
    EXPECT_EQ(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]), 1);
}

TEST(Delaunay, LeadingPointsOnOneLineMakeAFan) {
  for (const double apex : {-1.0, 1.0}) {  // to the right or left of the line's direction
    const Points points{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, apex}};
    const auto triangles = delaunay(points);
    EXPECT_EQ(triangles.size(), 3u);
    EXPECT_EQ(area(points, triangles), 1.5);
  }
}

TEST(CirclePoint, AgreesWithCosineAndSine) {
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    EXPECT_NEAR(circle_point(i, 1000).x(), std::cos(angle), 1e-15);
    EXPECT_NEAR(circle_point(i, 1000).y(), std::sin(angle), 1e-15);
  }
}

TEST(CirclePoint, QuarterTurnsAreExact) {
  EXPECT_EQ(circle_point(0, 8), Eigen::Vector2d(1, 0));
  EXPECT_EQ(circle_point(2, 8), Eigen::Vector2d(0, 1));
  EXPECT_EQ(circle_point(4, 8), Eigen::Vector2d(-1, 0));
  EXPECT_EQ(circle_point(6, 8), Eigen::Vector2d(0, -1));
}

TEST(UniformNumbers, StayInTheirRangeWithItsMean) {
  Uniform uniform(5);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = uniform(-1, 3);
    ASSERT_TRUE(x >= -1 && x < 3);
    sum += x;
  }
  EXPECT_NEAR(sum / 10000, 1, 5 * (4 / std::sqrt(12.0)) / 100);  // five standard errors
}

}  // namespace
}  // namespace hysteron
