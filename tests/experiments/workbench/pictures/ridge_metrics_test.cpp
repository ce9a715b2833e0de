// Measures of wrinkles on shapes whose wrinkles are known.
#include "experiments/workbench/pictures/ridge_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hysteron::experiments {
namespace {

constexpr double kRidgedSide = 0.2;

ClothMesh sheet() { return make_rectangle(kRidgedSide, kRidgedSide, 20000, MeshFamily::random, 1); }

constexpr double kHalfWidth = 6e-3;  // of a ridge above half of its height [m], more than any edge
constexpr double kRounding = 1e-5;   // of lengths, relative: values are single precision

// A ridge through the middle whose value falls off to both sides, by half in 6 mm.
std::vector<float> ridge_across(const ClothMesh& mesh, double angle) {
  const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
  std::vector<float> value;
  for (const Eigen::Vector3d& x : mesh.rest) {
    const double away = std::abs((x.head<2>() - Eigen::Vector2d::Constant(kRidgedSide / 2)).dot(normal));
    value.push_back(static_cast<float>(1 - away / (2 * kHalfWidth)));
  }
  return value;
}

// The outline of a ridge from edge to edge: both its sides, and its two ends on the border of the sheet.
// Along the diagonal the sides end at the corners' slopes.
TEST(RidgeLength, OfAStraightRidgeIsItsLengthAndItsWidthInEveryDirection) {
  const ClothMesh mesh = sheet();
  const double along_side = kRidgedSide + 2 * kHalfWidth;
  for (const double angle : {0.0, std::numbers::pi / 2})
    EXPECT_NEAR(ridge_length(mesh, ridge_across(mesh, angle), 0.5) / along_side, 1, kRounding) << angle;
  const double along_diagonal =
      std::sqrt(2.0) * kRidgedSide - 2 * kHalfWidth + 2 * std::sqrt(2.0) * kHalfWidth;
  EXPECT_NEAR(ridge_length(mesh, ridge_across(mesh, std::numbers::pi / 4), 0.5) / along_diagonal, 1,
              kRounding);
}

TEST(RidgeLength, DependsNeitherOnTheMeshsOrientationNorOnItsPlane) {
  const ClothMesh mesh = sheet();
  const std::vector<float> value = ridge_across(mesh, 0.3);
  const double length = ridge_length(mesh, value, 0.5);
  ASSERT_GT(length, kRidgedSide);
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0),
                                      Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 2, 3).normalized()}) {
    ClothMesh turned = mesh;
    for (const double degrees : {30.0, 45.0, 90.0}) {
      const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, axis);
      for (int i = 0; i < mesh.vertices(); ++i) turned.rest[i] = turn * mesh.rest[i];
      EXPECT_NEAR(ridge_length(turned, value, 0.5) / length, 1, 1e-9) << degrees << " about " << axis;
    }
  }
}

// Half the outline of a ring around a tube is its circumference, across the seam as anywhere.
TEST(RidgeLength, GoesAcrossTheSeamOfATube) {
  constexpr double kRadius = 0.05, kMiddle = 0.15;
  constexpr double kChords = 1e-3;  // of the circumference, by which some 45 chords are shorter than it
  const ClothMesh tube = make_tube(2 * kMiddle, kRadius, 4000, MeshFamily::unionjack, 1);
  std::vector<float> value;
  for (const Eigen::Vector3d& x : tube.rest)
    value.push_back(static_cast<float>(1 - std::abs(x.x() - kMiddle) / 0.04));
  EXPECT_NEAR(ridge_length(tube, value, 0.5) / (2 * std::numbers::pi * kRadius), 1, 2 * kChords);
}

// The panels of sewn cloth are at rest, whatever way their seams hold the vertices.
TEST(RidgeLength, OfSewnClothIsMeasuredOnItsPanels) {
  ClothMesh mesh = sheet();
  const std::vector<float> value = ridge_across(mesh, 0.3);
  const double length = ridge_length(mesh, value, 0.5);
  for (const Eigen::Vector3i& f : mesh.face)
    mesh.panel.push_back({mesh.rest[f[0]].head<2>(), mesh.rest[f[1]].head<2>(), mesh.rest[f[2]].head<2>()});
  mesh.sewn = true;
  for (Eigen::Vector3d& x : mesh.rest) x *= 0.5;
  EXPECT_NEAR(ridge_length(mesh, value, 0.5) / length, 1, 1e-9);
}

TEST(RidgeLength, IsZeroBelowTheThreshold) {
  const ClothMesh mesh = sheet();
  EXPECT_EQ(ridge_length(mesh, ridge_across(mesh, 0), 1.5), 0);
}

TEST(RidgeLength, OfTwoHalvesIsThatOfTheWhole) {
  const ClothMesh mesh = sheet();
  const std::vector<float> value = ridge_across(mesh, 0.3);
  std::vector<int> halves[2];
  for (int f = 0; f < mesh.faces(); ++f) halves[mesh.rest[mesh.face[f][0]].y() > 0.07].push_back(f);
  const double first = ridge_length(mesh, value, 0.5, halves[0]),
               second = ridge_length(mesh, value, 0.5, halves[1]);
  EXPECT_GT(first, 0.05);
  EXPECT_GT(second, 0.05);
  EXPECT_NEAR((first + second) / ridge_length(mesh, value, 0.5), 1, 1e-12);
}

// Straight ripples of this wavelength, which run at an angle to x.
std::vector<Eigen::Vector3d> rippled(const ClothMesh& mesh, double wavelength, double amplitude) {
  const Eigen::Vector2d along(std::cos(0.4), std::sin(0.4));
  std::vector<Eigen::Vector3d> x = mesh.rest;
  for (Eigen::Vector3d& p : x)
    p.z() += amplitude * std::sin(2 * std::numbers::pi * p.head<2>().dot(along) / wavelength);
  return x;
}

// Returns the vertices that are farther than this from the sheet's border [m].
std::vector<int> inside(const ClothMesh& mesh, double margin) {
  std::vector<int> found;
  for (int v = 0; v < mesh.vertices(); ++v)
    if ((mesh.rest[v].head<2>().array() - kRidgedSide / 2).abs().maxCoeff() < kRidgedSide / 2 - margin)
      found.push_back(v);
  return found;
}

double sine_height(double amplitude, double cutoff_over_wavelength) {
  return 2 * amplitude * std::sin(0.45 * std::numbers::pi) *
         (1 - std::exp2(-std::pow(cutoff_over_wavelength, 2)));
}

TEST(RidgeHeight, OfASineIsWhatTheGaussianMeanLeavesOfIt) {
  constexpr double kAmplitude = 1e-4, kCutoff = 0.02;
  constexpr double kSampled =
      0.02;  // of the height: edges of 2 mm, and weights that end where they are 0.6 %
  const ClothMesh mesh = sheet();
  const std::vector<int> part = inside(mesh, 0.6 * kCutoff);
  for (const double over : {2.0, 1.0, 0.5}) {
    const double expected = sine_height(kAmplitude, over);
    EXPECT_NEAR(ridge_height(mesh, rippled(mesh, kCutoff / over, kAmplitude), part, kCutoff) / expected, 1,
                kSampled / (1 - std::exp2(-over * over)))
        << over;
  }
}

TEST(RidgeHeight, DoesNotDependOnWhereTheClothIsAndHowItIsTurned) {
  const ClothMesh mesh = sheet();
  std::vector<Eigen::Vector3d> x = rippled(mesh, 0.01, 1e-3);
  const std::vector<int> part = inside(mesh, 0);
  const double height = ridge_height(mesh, x, part, 0.02);
  const Eigen::AngleAxisd turn(1, Eigen::Vector3d(1, 2, 3).normalized());
  for (Eigen::Vector3d& p : x) p = turn * p + Eigen::Vector3d(1, 2, 3);
  EXPECT_NEAR(ridge_height(mesh, x, part, 0.02) / height, 1, 1e-9);
}

// The mean lies inside a tube by some (0.187 cutoff)^2 / 2R, everywhere alike.
TEST(RidgeHeight, OfASmoothTubeIsNone) {
  const ClothMesh tube = make_tube(0.3, 0.05, 4000, MeshFamily::unionjack, 1);
  std::vector<int> middle;
  for (int v = 0; v < tube.vertices(); ++v)
    if (std::abs(tube.rest[v].x() - 0.15) < 0.1) middle.push_back(v);
  EXPECT_LT(ridge_height(tube, tube.rest, middle, 0.04), 2e-5);
}

// Layers as near to each other as their ripples are high do not mix.
TEST(RidgeHeight, KnowsPiecesOfClothApart) {
  const ClothMesh mesh = sheet(), two = copied_mesh(mesh, 2, {0, 0, 1e-3});
  const std::vector<Eigen::Vector3d> one_up = rippled(mesh, 0.01, 1e-3);
  std::vector<Eigen::Vector3d> x = one_up;
  for (const Eigen::Vector3d& p : mesh.rest) x.push_back(p + Eigen::Vector3d(0, 0, 1e-3));
  const std::vector<int> part = inside(mesh, 0);
  EXPECT_NEAR(ridge_height(two, x, part, 0.02) / ridge_height(mesh, one_up, part, 0.02), 1, 1e-9);
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
  shape.shape = ClothOutline::tube;
  shape.radius = 0.05;
  double low = 0, high = 0;
  for (const Eigen::Vector2d& p : unrolled_tube(tube, shape))
    low = std::min(low, p.y()), high = std::max(high, p.y());
  EXPECT_NEAR((high - low) / (2 * std::numbers::pi * 0.05), 1, 0.05);
}

}  // namespace
}  // namespace hysteron::experiments
