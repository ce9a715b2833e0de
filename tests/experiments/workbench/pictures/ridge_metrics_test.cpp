// Measures of wrinkles on shapes whose wrinkles are known.
#include "experiments/workbench/pictures/ridge_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hysteron::experiments {
namespace {

constexpr double kRidgedSide = 0.2;

ClothMesh sheet() { return make_rectangle(kRidgedSide, kRidgedSide, 20000, MeshFamily::random, 1); }

// A ridge through the middle whose value falls off to both sides, by half in 4 mm.
std::vector<float> ridge_across(const ClothMesh& mesh, double angle) {
  const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
  std::vector<float> value;
  for (const Eigen::Vector3d& x : mesh.rest) {
    const double away = std::abs((x.head<2>() - Eigen::Vector2d::Constant(kRidgedSide / 2)).dot(normal));
    value.push_back(static_cast<float>(1 - away / 8e-3));
  }
  return value;
}

std::vector<Eigen::Vector2d> flat(const ClothMesh& mesh) { return unrolled(mesh, {}); }

// A ridge from edge to edge: test lines across it meet it, those along it do not; the mean over both is pi/4
// of its length for one along x or y, and right on average over directions.
TEST(RidgeLength, OfAStraightRidgeIsItsLengthUpToItsDirection) {
  const ClothMesh mesh = sheet();
  EXPECT_NEAR(
      ridge_length(mesh, flat(mesh), ridge_across(mesh, 0), 0.5, 1e-3) / (std::numbers::pi / 4 * kRidgedSide),
      1, 0.03);
  const double diagonal = std::sqrt(2.0) * kRidgedSide;
  EXPECT_NEAR(ridge_length(mesh, flat(mesh), ridge_across(mesh, std::numbers::pi / 4), 0.5, 1e-3) / diagonal,
              std::numbers::pi / 4 * std::sqrt(2.0), 0.05);
}

TEST(RidgeLength, IsZeroBelowTheThreshold) {
  const ClothMesh mesh = sheet();
  EXPECT_EQ(ridge_length(mesh, flat(mesh), ridge_across(mesh, 0), 1.5, 1e-3), 0);
}

TEST(AreaFractions, SumToOneWithTheLargestInTheLastBin) {
  const std::vector<double> fraction = area_fractions({0.5, 1.5, 99}, {1, 2, 1}, 1, 3);
  EXPECT_EQ(fraction, (std::vector<double>{0.25, 0.5, 0.25}));
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
