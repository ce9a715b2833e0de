#include "sim/mesh/topology.h"

#include <gtest/gtest.h>

#include "sim/mesh/random_points.h"

namespace hysteron {
namespace {

TEST(Weld, JoinsPointsCloserThanTheDistanceToTheFirst) {
  const std::vector<Eigen::Vector3d> points{
      {0, 0, 0}, {1, 0, 0}, {1, 0.9e-3, 0}, {0, 0, -0.9e-3}, {1, 1.1e-3, 0}};
  EXPECT_EQ(nearby_representatives(points, 1e-3), (std::vector<int>{0, 1, 1, 0, 4}));
}

TEST(Weld, AgreesWithTryingAllPairs) {
  Uniform uniform(3);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 600; ++i) {
    const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    points.emplace_back(x, y, z);
  }
  const double distance = 0.2;
  const std::vector<int> representative = nearby_representatives(points, distance);
  int joined = 0;
  for (int i = 0; i < 600; ++i) {
    int expected = i;
    for (int j = i - 1; j >= 0; --j)
      if (representative[j] == j && (points[i] - points[j]).norm() < distance) expected = j;
    EXPECT_EQ(representative[i], expected);
    joined += expected != i;
  }
  EXPECT_GT(joined, 100);
}

TEST(Weld, DistanceFarBelowTheExtentJoinsEqualPointsOnly) {
  const std::vector<Eigen::Vector3d> points{{1e6, 0, 0}, {1e6, 0, 1e-9}, {1e6, 0, 0}};
  EXPECT_EQ(nearby_representatives(points, 1e-300), (std::vector<int>{0, 1, 0}));
}

}  // namespace
}  // namespace hysteron
