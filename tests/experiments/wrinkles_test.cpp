// Measures of wrinkles on shapes whose wrinkles are known.
#include "experiments/wrinkles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace hysteron::experiments {
namespace {

constexpr double kSide = 0.2;

ClothMesh sheet() { return make_rectangle(kSide, kSide, 20000, MeshFamily::random, 1); }

std::vector<float> ridge_across(const ClothMesh& mesh, double angle) {
  const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
  std::vector<float> value;
  for (const Eigen::Vector3d& x : mesh.rest)
    value.push_back(std::abs((x.head<2>() - Eigen::Vector2d::Constant(kSide / 2)).dot(normal)) < 4e-3 ? 1.0f
                                                                                                      : 0.0f);
  return value;
}

std::vector<Eigen::Vector2d> flat(const ClothMesh& mesh) { return unrolled(mesh, {}); }

// A ridge from edge to edge: test lines across it meet it, those along it do not; the mean over both is pi/4
// of its length for one along x or y, and right on average over directions.
TEST(RidgeLength, OfAStraightRidgeIsItsLengthUpToItsDirection) {
  const ClothMesh mesh = sheet();
  EXPECT_NEAR(
      ridge_length(mesh, flat(mesh), ridge_across(mesh, 0), 0.5, 1e-3) / (std::numbers::pi / 4 * kSide), 1,
      0.03);
  const double diagonal = std::sqrt(2.0) * kSide;
  EXPECT_NEAR(ridge_length(mesh, flat(mesh), ridge_across(mesh, std::numbers::pi / 4), 0.5, 1e-3) / diagonal,
              std::numbers::pi / 4 * std::sqrt(2.0), 0.05);
}

TEST(RidgeLength, IsZeroBelowTheThreshold) {
  const ClothMesh mesh = sheet();
  EXPECT_EQ(ridge_length(mesh, flat(mesh), ridge_across(mesh, 0), 1.5, 1e-3), 0);
}

TEST(Relief, OfATiltedPlaneIsNoneAndOfAWaveItsRootMeanSquare) {
  const ClothMesh mesh = sheet();
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  constexpr double kDepth = 2e-3;
  std::vector<Eigen::Vector3d> plane, wave;
  for (const Eigen::Vector3d& x : mesh.rest) {
    plane.push_back(turn * x);
    wave.push_back(turn *
                   (x + Eigen::Vector3d(0, 0, kDepth * std::sin(2 * std::numbers::pi * 4 * x.x() / kSide))));
  }
  EXPECT_LT(relief(mesh, plane), 1e-9);
  EXPECT_NEAR(relief(mesh, wave) / (kDepth / std::sqrt(2.0)), 1, 0.02);
}

TEST(AreaShares, SumToOneWithTheLargestInTheLastBin) {
  const std::vector<double> share = area_shares({0.5, 1.5, 99}, {1, 2, 1}, 1, 3);
  EXPECT_EQ(share, (std::vector<double>{0.25, 0.5, 0.25}));
}

TEST(CurvatureSize, IsTheNormOfATensorAndTheMagnitudeOfAHinge) {
  EXPECT_EQ(curvature_size({3, 0, 4, 0, 0, 0}, 3), (std::vector<double>{5, 0}));
  EXPECT_EQ(curvature_size({-2, 1}, 1), (std::vector<double>{2, 1}));
}

TEST(UnrolledTube, IsAsWideAsItsCircumference) {
  const ClothMesh tube = make_tube(0.3, 0.05, 4000, MeshFamily::unionjack, 1);
  ClothShape shape;
  shape.shape = "tube";
  shape.radius = 0.05;
  double low = 0, high = 0;
  for (const Eigen::Vector2d& p : unrolled(tube, shape))
    low = std::min(low, p.y()), high = std::max(high, p.y());
  EXPECT_NEAR((high - low) / (2 * std::numbers::pi * 0.05), 1, 0.05);
}

}  // namespace
}  // namespace hysteron::experiments
