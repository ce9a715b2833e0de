#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using test::kFamilies;

ClothMesh two_triangles() {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.face = {{0, 1, 2}, {0, 2, 3}};
  build_topology(mesh, "two triangles");
  return mesh;
}

bool same_cycle(const Eigen::Vector3i& face, const Eigen::Vector3i& expected) {
  for (int i = 0; i < 3; ++i)
    if (face == Eigen::Vector3i(expected[i], expected[(i + 1) % 3], expected[(i + 2) % 3])) return true;
  return false;
}

Eigen::Vector3d normal(const ClothMesh& mesh, int f) {
  const auto& t = mesh.face[f];
  return (mesh.rest[t[1]] - mesh.rest[t[0]]).cross(mesh.rest[t[2]] - mesh.rest[t[0]]).normalized();
}

TEST(Topology, TwoTrianglesShareOneHinge) {
  const ClothMesh mesh = two_triangles();
  ASSERT_EQ(mesh.interior_edges, 1);
  ASSERT_EQ(mesh.edge.size(), 5u);
  const Edge& hinge = mesh.edge[0];
  EXPECT_EQ(hinge.face0, 0);
  EXPECT_EQ(hinge.face1, 1);
  EXPECT_EQ(hinge.p0, 1);
  EXPECT_EQ(hinge.p1, 3);
  EXPECT_EQ(hinge.p2, 2);
  EXPECT_EQ(hinge.p3, 0);
}

TEST(Topology, StencilIsFaceZeroP2P3P0AndFaceOneP3P2P1InEveryFamily) {
  for (const MeshFamily family : kFamilies) {
    const ClothMesh mesh = make_disc(1, 300, family, 1);
    for (std::size_t e = 0; e < mesh.edge.size(); ++e) {
      const Edge& edge = mesh.edge[e];
      EXPECT_EQ(edge.interior(), static_cast<int>(e) < mesh.interior_edges);
      EXPECT_TRUE(same_cycle(mesh.face[edge.face0], {edge.p2, edge.p3, edge.p0}));
      if (edge.interior()) {
        EXPECT_TRUE(same_cycle(mesh.face[edge.face1], {edge.p3, edge.p2, edge.p1}));
      } else {
        EXPECT_EQ(edge.p1, -1);
      }
    }
  }
}

// z = x^2/2 is concave seen from +z; the header's sign needs p0 and p1 above the plane of the other triangle.
TEST(Topology, OppositeCornersOfABowlLieOnTheFrontOfTheNeighbour) {
  ClothMesh mesh = make_disc(1, 200, MeshFamily::equilateral, 1);
  for (auto& x : mesh.rest) x.z() = 0.5 * x.head<2>().squaredNorm();
  build_topology(mesh, "bowl");
  for (int e = 0; e < mesh.interior_edges; ++e) {
    const Edge& edge = mesh.edge[e];
    EXPECT_GT(normal(mesh, edge.face1).dot(mesh.rest[edge.p0] - mesh.rest[edge.p2]), 0);
    EXPECT_GT(normal(mesh, edge.face0).dot(mesh.rest[edge.p1] - mesh.rest[edge.p2]), 0);
  }
}

TEST(Topology, FaceEdgeIsOppositeToItsCorner) {
  const ClothMesh mesh = make_rectangle(1, 0.7, 200, MeshFamily::random, 3);
  for (int f = 0; f < mesh.faces(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = mesh.edge[mesh.face_edge[f][i]];
      EXPECT_EQ(edge.face0 == f ? edge.p0 : edge.p1, mesh.face[f][i]);
      EXPECT_TRUE(edge.face0 == f || edge.face1 == f);
    }
  }
}

TEST(Topology, VertexFacesListEveryCornerOnceAtItsVertex) {
  const ClothMesh mesh = make_rectangle(1, 0.7, 200, MeshFamily::unionjack, 0);
  std::vector<int> seen(3 * mesh.face.size(), 0);
  for (int v = 0; v < mesh.vertices(); ++v) {
    for (int k = mesh.vertex_faces.start[v]; k < mesh.vertex_faces.start[v + 1]; ++k) {
      const int corner = mesh.vertex_faces.item[k];
      EXPECT_EQ(mesh.face[corner / 3][corner % 3], v);
      ++seen[corner];
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST(Topology, VertexAreasAddUpToTheSheet) {
  const ClothMesh mesh = make_rectangle(0.5, 0.3, 1000, MeshFamily::random, 5);
  const double sum = std::accumulate(mesh.vertex_area.begin(), mesh.vertex_area.end(), 0.0);
  EXPECT_NEAR(sum, 0.5 * 0.3, test::kSumRounding);
}

TEST(Topology, ClosedSurfaceHasNoBoundary) {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.face = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  build_topology(mesh, "tetrahedron");
  EXPECT_EQ(mesh.interior_edges, 6);
  EXPECT_EQ(mesh.edge.size(), 6u);
  EXPECT_EQ(test::euler_characteristic(mesh), 2);
}

TEST(WarpAxes, AreOrthonormalInThePlaneWithWarpTowardsTheAxis) {
  ClothMesh mesh = make_disc(1, 100, MeshFamily::random, 1);
  for (auto& x : mesh.rest) x.z() = 0.3 * x.x() + 0.2 * x.y() * x.y();
  build_topology(mesh, "curved disc");
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto [warp, weft] = mesh.face_axes(f);
    EXPECT_NEAR(warp.norm(), 1, 1e-15);
    EXPECT_NEAR(warp.dot(normal(mesh, f)), 0, 1e-15);
    EXPECT_NEAR((warp.cross(weft) - normal(mesh, f)).norm(), 0, 1e-15);
    const Eigen::Vector3d across = mesh.warp_axis.cross(normal(mesh, f));
    EXPECT_NEAR(warp.dot(across), 0, 1e-15);
    EXPECT_GT(warp.dot(mesh.warp_axis), 0);
  }
}

TEST(WarpAxes, FollowThePatternWhereverTheSheetIsTurned) {
  ClothMesh mesh = make_rectangle(1, 1, 32, MeshFamily::aligned, 0);
  const double angle = 0.7;
  const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0);
  for (const auto& x : mesh.rest)  // coordinates along and across the direction
    mesh.pattern.emplace_back(direction.dot(x), direction.x() * x.y() - direction.y() * x.x());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (auto& x : mesh.rest) x = turn * x;
  for (int f = 0; f < mesh.faces(); ++f)
    EXPECT_NEAR((mesh.face_axes(f)[0] - turn * direction).norm(), 0, 1e-14);
}

TEST(WarpAxes, AreThoseOfEachTrianglesOwnTexture) {
  ClothMesh mesh = two_triangles();
  const Eigen::Vector2d zero(0, 0), one(1, 0), both(1, 1), other(0, 1);
  mesh.panel = {{zero, other, Eigen::Vector2d(-1, 1)}, {both, zero, one}};  // turned by 90 and by 180 degrees
  EXPECT_NEAR((mesh.face_axes(0)[0] - Eigen::Vector3d(0, -1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((mesh.face_axes(1)[0] - Eigen::Vector3d(-1, 0, 0)).norm(), 0, 1e-15);
}

TEST(WarpAxes, TurnInTheTexture) {
  ClothMesh mesh = two_triangles();
  for (const auto& x : mesh.rest) mesh.pattern.emplace_back(3 * x.y(), -3 * x.x());
  const double angle = 0.4;
  mesh.warp_axis = {std::cos(angle), std::sin(angle), 0};
  const Eigen::Vector3d first(0, 1, 0), second(-1, 0, 0);  // directions of rising texture coordinates
  const Eigen::Vector3d expected = std::cos(angle) * first + std::sin(angle) * second;
  for (int f = 0; f < mesh.faces(); ++f) EXPECT_NEAR((mesh.face_axes(f)[0] - expected).norm(), 0, 1e-15);
}

TEST(WarpAxes, TriangleAcrossTheAxisTakesItsFirstEdge) {
  ClothMesh mesh = two_triangles();
  mesh.warp_axis = {0, 0, 1};
  EXPECT_NEAR((mesh.face_axes(0)[0] - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace hysteron
