// Points of the cloth are found by their places on the flat cloth.
#include "sim/mesh/material_point.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPointRounding = 1e-15;

TEST(MaterialPoint, LiesWhereItIsAskedForOnEveryFlatMesh) {
  for (const MeshFamily family : {MeshFamily::aligned, MeshFamily::unionjack, MeshFamily::random}) {
    const ClothMesh mesh = make_rectangle(0.3, 0.2, 100, family, 1);
    for (const Vector2d& at :
         {Vector2d(0, 0), Vector2d(0.3, 0.2), Vector2d(0.15, 0.1), Vector2d(0.011, 0.173)}) {
      const auto point = material_point(mesh, at);
      ASSERT_TRUE(point);
      EXPECT_LT((point->among(mesh, mesh.rest) - Vector3d(at.x(), at.y(), 0)).norm(), kPointRounding);
    }
  }
}

// The motion x -> A x + b takes each point, not the corners of triangles alone, to A x + b.
TEST(MaterialPoint, FollowsAnAffineMotionOfTheCloth) {
  const ClothMesh mesh = make_disc(0.1, 200, MeshFamily::equilateral, 1);
  Eigen::Matrix3d stretched;
  stretched << 1.2, 0.3, 0, -0.1, 0.9, 0, 0.4, 0.2, 1;
  const Vector3d moved(1, 2, 3);
  std::vector<Vector3d> x;
  for (const Vector3d& rest : mesh.rest) x.push_back(stretched * rest + moved);
  const Vector3d at(0.031, -0.052, 0);
  const Vector3d found = material_point(mesh, at.head<2>())->among(mesh, x);
  EXPECT_LT((found - (stretched * at + moved)).norm(), 4 * kPointRounding);
}

TEST(MaterialPoint, IsNoneBesideTheCloth) {
  const ClothMesh disc = make_disc(0.1, 200, MeshFamily::equilateral, 1);
  EXPECT_TRUE(material_point(disc, {0.0999, 0}));
  EXPECT_FALSE(material_point(disc, {0.0801, 0.0601}));  // 0.1002 m from the middle
  const ClothMesh strip = make_rectangle(0.3, 0.2, 100, MeshFamily::aligned, 1);
  EXPECT_TRUE(material_point(strip, {0.3 + 1e-10, 0.1}));
  EXPECT_FALSE(material_point(strip, {0.3 + 1e-8, 0.1}));
}

TEST(MaterialPoint, HasTheHingeOfTheEdgeThatIsNearestToIt) {
  const ClothMesh mesh = make_grid(0.2, 0.1, 2, 1, MeshFamily::aligned, 1);
  // On the seam of the two cells, x = 0.1 m; at the outer edges the diagonals are the only hinges.
  for (const Vector2d& at : {Vector2d(0.099, 0.05), Vector2d(0.101, 0.05)}) {
    const int hinge = nearest_hinge(mesh, *material_point(mesh, at));
    EXPECT_EQ(mesh.rest[mesh.edge[hinge].p2].x(), 0.1);
    EXPECT_EQ(mesh.rest[mesh.edge[hinge].p3].x(), 0.1);
  }
  const int hinge = nearest_hinge(mesh, *material_point(mesh, {0.001, 0.05}));
  EXPECT_NE(mesh.rest[mesh.edge[hinge].p2].x(), mesh.rest[mesh.edge[hinge].p3].x());
}

TEST(FlatCloth, IsOneWhoseTrianglesAllLieInPlanesOfConstantHeight) {
  const ClothMesh mesh = make_grid(0.2, 0.1, 2, 1, MeshFamily::aligned, 1);
  EXPECT_TRUE(is_flat(mesh));
  EXPECT_TRUE(is_flat(copied_mesh(mesh, 3, {0, 0, 0.01})));
  EXPECT_FALSE(is_flat(make_tube(0.2, 0.05, 100, MeshFamily::aligned, 1)));
}

}  // namespace
}  // namespace hysteron
