#include "render/shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

const Eigen::Vector3f& corner(const TriangleMesh& mesh, size_t triangle, int k) {
  return mesh.positions[mesh.triangles[3 * triangle + k]];
}

// Returns the volume by the divergence theorem; it is positive only if the triangles face outward.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (size_t t = 0; t < mesh.triangle_count(); ++t)
    sum += corner(mesh, t, 0).dot(corner(mesh, t, 1).cross(corner(mesh, t, 2))) / 6.0;
  return sum;
}

void expect_unit_normals_along_triangles(const TriangleMesh& mesh) {
  for (const Eigen::Vector3f& normal : mesh.normals) ASSERT_NEAR(normal.norm(), 1, 1e-5);
  for (size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3f face =
        (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
    if (face.norm() < 1e-8f) continue;  // at a pole only roundings are left
    for (int k = 0; k < 3; ++k)
      ASSERT_GT(mesh.normals[mesh.triangles[3 * t + k]].dot(face), 0) << "triangle " << t;
  }
}

// Chords of 96 sectors cut off 0.07 % of a circle's area, coarser meridians of rims a little more.
constexpr double kChords = 0.004;

TEST(Shapes, VolumesAreTheClosedForms) {
  EXPECT_NEAR(volume(sphere_mesh(2)) / (4.0 / 3 * kPi * 8), 1, kChords);
  EXPECT_NEAR(volume(cylinder_mesh(0.5f, 2, 0)) / (kPi * 0.25 * 2), 1, kChords);
  EXPECT_NEAR(volume(capsule_mesh(0.5f, 2)) / (kPi * 0.25 * 2 + 4.0 / 3 * kPi * 0.125), 1, kChords);
  EXPECT_NEAR(volume(torus_mesh(0.5f, 0.2f)) / (2 * kPi * 0.5 * kPi * 0.01), 1, kChords);
  EXPECT_NEAR(volume(box_mesh({1, 2, 3}, 0)) / (8 * 6), 1, kChords);
}

TEST(Shapes, NormalsPointOutward) {
  expect_unit_normals_along_triangles(sphere_mesh(1));
  expect_unit_normals_along_triangles(cylinder_mesh(0.045f, 0.12f, 0.002f));
  expect_unit_normals_along_triangles(capsule_mesh(0.1f, 0.3f));
  expect_unit_normals_along_triangles(torus_mesh(0.05f, 0.01f));
  expect_unit_normals_along_triangles(box_mesh({0.1f, 0.2f, 0.05f}, 0.01f));
}

// A rounded rim removes from the cylinder the ring between the square corner and the quarter circle.
TEST(Shapes, CylinderRimIsRound) {
  const TriangleMesh mesh = cylinder_mesh(0.5f, 1, 0.1f);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const float across = mesh.positions[i].head<2>().norm(), up = std::abs(mesh.positions[i].z());
    EXPECT_LE(across, 0.5f + 1e-5f);
    EXPECT_LE(up, 0.5f + 1e-5f);
    if (across > 0.4f && up > 0.4f) {
      EXPECT_NEAR(std::hypot(across - 0.4f, up - 0.4f), 0.1f, 1e-5f);
    }
  }
}

TEST(Shapes, BoxHasItsEdgesAndRoundCorners) {
  const TriangleMesh mesh = box_mesh({0.3f, 0.2f, 0.1f}, 0.02f);
  Eigen::Vector3f reach = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : mesh.positions) reach = reach.cwiseMax(p.cwiseAbs());
  EXPECT_TRUE(reach.isApprox(Eigen::Vector3f(0.3f, 0.2f, 0.1f), 1e-5f));
  const Eigen::Vector3f inner(0.28f, 0.18f, 0.08f);
  for (const Eigen::Vector3f& p : mesh.positions)
    EXPECT_LE((p.cwiseAbs() - inner).cwiseMax(0.0f).norm(), 0.02f + 1e-6f);
}

TEST(Shapes, PlacementTurnsTheAxisAndMovesTheCentre) {
  const Eigen::Vector3f axis = Eigen::Vector3f(1, 2, -0.5f).normalized(), center(3, 4, 5);
  const Eigen::Matrix4f placement = placed(center, 7 * axis);
  EXPECT_TRUE((placement.topLeftCorner<3, 3>() * Eigen::Vector3f::UnitZ()).isApprox(axis, 1e-5f));
  EXPECT_NEAR((placement.topLeftCorner<3, 3>().determinant()), 1, 1e-5);
  EXPECT_EQ((placement * Eigen::Vector4f(0, 0, 0, 1)).head<3>().eval(), center);
}

}  // namespace
}  // namespace hysteron::render
