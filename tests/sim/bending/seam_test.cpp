// Bending across seams: panels that are sewn together bend as the whole cloth does.
#include <gtest/gtest.h>

#include "sim/bending/bending.h"
#include "sim/bending/curvature_operator.h"

namespace hysteron {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSeamRadius = 0.05;     // [m]
constexpr double kSeamRounding = 1e-10;  // relative; the fit of H amplifies it

ClothMesh sheet() { return make_rectangle(0.2, 0.1, 160, MeshFamily::random, 1); }

// The sheet cut across its middle into two panels, the second turned by `angle` and moved, sewn together
// again and worn around a cylinder.
ClothMesh cut_and_sewn(double angle) {
  ClothMesh mesh = sheet();
  const Eigen::Rotation2Dd turn(angle);
  for (const auto& t : mesh.face) {
    const bool second = (mesh.rest[t[0]] + mesh.rest[t[1]] + mesh.rest[t[2]]).x() / 3 > 0.1;
    std::array<Vector2d, 3> at;
    for (int k = 0; k < 3; ++k) {
      at[k] = mesh.rest[t[k]].head<2>();
      if (second) at[k] = turn * at[k] + Vector2d(3, 1);
    }
    mesh.panel.push_back(at);
  }
  for (Vector3d& x : mesh.rest)
    x = {kSeamRadius * std::sin(x.x() / kSeamRadius), x.y(),
         kSeamRadius * (1 - std::cos(x.x() / kSeamRadius))};
  mesh.sewn = true;
  build_topology(mesh, "sewn sheet");
  return mesh;
}

// Sizes of the curvatures [1/m] that a unit angle of each hinge (column) adds to each element (row).
MatrixXd sizes(const CurvatureOperator& op, int hinges) {
  MatrixXd c = MatrixXd::Zero(op.elements(), hinges);
  for (int i = 0; i < op.elements(); ++i)
    for (int j = op.hinge.start[i]; j < op.hinge.start[i + 1]; ++j) {
      double square = 0;
      for (int k = 0; k < op.dimension; ++k) square += std::pow(op.coefficient[op.dimension * j + k], 2);
      c(i, op.hinge.item[j]) = std::sqrt(square);
    }
  return c;
}

TEST(Seams, AreFlatAtRestLikeThePanels) {
  for (const double angle : rest_angles(cut_and_sewn(0.6))) EXPECT_EQ(angle, 0);
}

TEST(Seams, BendAsTheClothDoesWithinAPanel) {
  const ClothMesh whole = sheet();
  const std::vector<char> held(whole.vertices());
  for (const BendingElement element : {BendingElement::hinge, BendingElement::shape})
    for (const double angle : {0.0, 0.6}) {
      const ClothMesh sewn = cut_and_sewn(angle);
      ASSERT_EQ(sewn.face, whole.face);
      const MatrixXd a = sizes(make_curvature_operator(element, whole, held), whole.interior_edges),
                     b = sizes(make_curvature_operator(element, sewn, held), whole.interior_edges);
      EXPECT_LT((a - b).norm(), kSeamRounding * a.norm());
    }
}

TEST(Seams, LeaveTheHighestFrequencyOfBendingAsItIs) {
  const ClothMesh whole = sheet(), sewn = cut_and_sewn(0);
  const std::vector<char> held(whole.vertices());
  const auto radius = [&](const ClothMesh& mesh) {
    const CurvatureOperator op = make_shape_operator(mesh, held);
    return bending_spectral_radius(mesh, op, 1e-5, mesh.vertex_area, held);
  };
  EXPECT_NEAR(radius(sewn) / radius(whole), 1, kSeamRounding);
}

// Pieces of a seam whose sides differ in length meet in their middles, whichever side comes first.
TEST(Seams, WithEaseBendAlikeFromBothSides) {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}};
  mesh.face = {{0, 1, 2}, {1, 0, 3}};
  mesh.panel = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(0.5, 1)},
                {Vector2d(0.7, 0), Vector2d(-0.5, 0), Vector2d(0.1, -1)}};
  mesh.sewn = true;
  build_topology(mesh, "two triangles");
  const auto [p0, p1, p2, p3] = rest_hinge(mesh, 0);
  EXPECT_LT((p2 - Vector3d(-0.55, 0, 0)).norm(), 1e-15);
  EXPECT_LT((p3 - Vector3d(0.55, 0, 0)).norm(), 1e-15);
  EXPECT_LT((p0 - Vector3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((p1 - Vector3d(0, -1, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace hysteron
