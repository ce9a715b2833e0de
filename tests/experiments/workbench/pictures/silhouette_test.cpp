// Silhouettes of shapes whose overlap has a formula.
#include "experiments/workbench/pictures/silhouette.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron::experiments {
namespace {

constexpr double kSquareSide = 0.2;
constexpr double kGridCells =
    3e-3;  // of shares: a thousandth of the extent, on each of the sides that differ

class Silhouette : public testing::Test {
 protected:
  double change(const Eigen::Affine3d& motion, const Eigen::Vector3d& direction) const {
    std::vector<Eigen::Vector3d> now = mesh_.rest;
    for (Eigen::Vector3d& x : now) x = motion * x;
    return silhouette_change(mesh_.face, mesh_.rest, now, direction);
  }

  const ClothMesh mesh_ = make_rectangle(kSquareSide, kSquareSide, 500, MeshFamily::random, 1);
};

// By d along a side: of L + d what one alone covers is 2 d.
TEST_F(Silhouette, OfAShiftedSquareChangesByWhatOneAloneCovers) {
  for (const double d : {0.0, 0.02, 0.1})
    EXPECT_NEAR(change(Eigen::Affine3d(Eigen::Translation3d(d, 0, 0)), {0, 0, 1}), 2 * d / (kSquareSide + d),
                kGridCells)
        << d;
  EXPECT_EQ(change(Eigen::Affine3d(Eigen::Translation3d(2 * kSquareSide, 0, 0)), {0, 0, 1}), 1);
}

TEST_F(Silhouette, DoesNotChangeByWhatMovesAlongTheView) {
  const Eigen::Vector3d direction(1, 2, 3);
  EXPECT_NEAR(change(Eigen::Affine3d(Eigen::Translation3d(0.1 * direction)), direction), 0, kGridCells);
}

// Two squares turned by 45 degrees share a regular octagon of 2 (sqrt 2 - 1) L^2.
TEST_F(Silhouette, OfATurnedSquareKeepsAnOctagon) {
  const Eigen::Vector3d middle(kSquareSide / 2, kSquareSide / 2, 0);
  const Eigen::Affine3d turn = Eigen::Translation3d(middle) *
                               Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitZ()) *
                               Eigen::Translation3d(-middle);
  const double shared = 2 * (std::numbers::sqrt2 - 1);
  EXPECT_NEAR(change(turn, {0, 0, -1}), 1 - shared / (2 - shared), kGridCells);
}

// Tilted about a side by 60 degrees it covers half of what it did.
TEST_F(Silhouette, OfATiltedSquareIsAsNarrowAsItsCosine) {
  const Eigen::Affine3d tilt(Eigen::AngleAxisd(std::numbers::pi / 3, Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(change(tilt, {0, 0, 1}), 0.5, kGridCells);
}

TEST_F(Silhouette, SeenEdgeOnCoversNothing) {
  EXPECT_EQ(change(Eigen::Affine3d(Eigen::Translation3d(0, 0.01, 0)), {1, 0, 0}), 0);
}

}  // namespace
}  // namespace hysteron::experiments
