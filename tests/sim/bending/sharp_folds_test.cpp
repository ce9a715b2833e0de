// What a fold costs that is sharp for its triangles: facets with vertices on a cylinder tilt along its axis
// unless an edge lies along it, and their bending is too soft by two thirds of the mean square of that tilt.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/bending/curvature_operator.h"
#include "sim/bending/facet_tilt.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {
namespace {

constexpr double kSide = 0.2;  // of the cloth [m]
constexpr int kTriangles = 2000;

// Positions on a cylinder along y whose curvature along x is `curvature` [1/m], lengths kept.
std::vector<Eigen::Vector3d> wrapped(const ClothMesh& mesh, double curvature) {
  std::vector<Eigen::Vector3d> x;
  for (const Eigen::Vector3d& p : mesh.rest)
    x.emplace_back(std::sin(curvature * p.x()) / curvature, p.y(),
                   (1 - std::cos(curvature * p.x())) / curvature);
  return x;
}

bool is_inner(const ClothMesh& mesh, int face) {
  constexpr double kBorder = 0.2;  // of the side; the free edges' projection ends there
  for (const Eigen::Vector3d& p : mesh.corners(face))
    for (const double c : {p.x(), p.y()})
      if (c < kBorder * kSide || c > (1 - kBorder) * kSide) return false;
  return true;
}

struct Softness {
  double measured, predicted;  // relative error of the bending energy
};

Softness softness(MeshFamily family, unsigned seed, double angle) {
  const ClothMesh mesh = make_rectangle(kSide, kSide, kTriangles, family, seed);
  const CurvatureOperator op = make_shape_operator(mesh, std::vector<char>(mesh.vertices()));
  const double side = std::sqrt(2 * kSide * kSide / mesh.faces()), curvature = angle / side;
  const std::vector<double> theta = hinge_angles(mesh, wrapped(mesh, curvature));
  const std::vector<double> tilt = FacetTilt(mesh).tilts(theta);
  double energy = 0, area = 0, tilts = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    if (!is_inner(mesh, f)) continue;
    Eigen::Vector3d s = Eigen::Vector3d::Zero();
    for (int j = op.hinge.start[f]; j < op.hinge.start[f + 1]; ++j)
      for (int k = 0; k < 3; ++k) s[k] += op.coefficient[3 * j + k] * theta[op.hinge.item[j]];
    energy += op.area[f] * s.squaredNorm();
    area += op.area[f];
    tilts += op.area[f] * std::pow(tilt[f], 2);
  }
  return {energy / (curvature * curvature * area) - 1, -2.0 / 3 * tilts / area};
}

TEST(SharpFolds, CostNothingWhereEdgesLieAlongTheAxis) {
  for (const double angle : {0.25, 0.5, 1.0}) {
    const Softness aligned = softness(MeshFamily::aligned, 1, angle);
    EXPECT_NEAR(aligned.measured, 0, 1e-9) << angle;
    EXPECT_NEAR(aligned.predicted, 0, 1e-9) << angle;
  }
}

// To fourth order in the angle; chords that are shorter than arcs add up to a fifth.
TEST(SharpFolds, CostTwoThirdsOfTheFacetsMeanSquareTiltElsewhere) {
  constexpr double kAngle = 0.25;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Softness random = softness(MeshFamily::random, seed, kAngle);
    EXPECT_LT(random.predicted, 0);
    EXPECT_NEAR(random.measured / random.predicted, 1, 0.35) << random.measured << " " << random.predicted;
    const double twice = softness(MeshFamily::random, seed, 2 * kAngle).measured;
    EXPECT_NEAR(twice / random.measured, 4, 0.6);
  }
}

}  // namespace
}  // namespace hysteron
