#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using test::kFamilies;

constexpr double kLength = 0.5, kWidth = 0.3;  // [m]
// Counts of whole cells miss the request by at most half a row of cells.
double stated_share(int triangles) { return std::sqrt(2.0 / triangles); }

class Rectangle : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(Families, Rectangle, testing::ValuesIn(kFamilies), test::CaseName());

TEST_P(Rectangle, HasEulerCharacteristicOfADisc) {
  for (const int n : test::kMeshSizes)
    EXPECT_EQ(test::euler_characteristic(make_rectangle(kLength, kWidth, n, GetParam(), 1)), 1) << n;
}

TEST_P(Rectangle, AreaIsLengthTimesWidth) {
  for (const int n : test::kMeshSizes) {
    const ClothMesh mesh = make_rectangle(kLength, kWidth, n, GetParam(), 1);
    EXPECT_NEAR(test::total_area(mesh), kLength * kWidth, test::kSumRounding * kLength * kWidth) << n;
  }
}

TEST_P(Rectangle, EveryTriangleShowsItsFrontToPlusZ) {
  const ClothMesh mesh = make_rectangle(kLength, kWidth, 1000, GetParam(), 1);
  for (const auto& t : mesh.face)
    EXPECT_GT((mesh.rest[t[1]] - mesh.rest[t[0]]).cross(mesh.rest[t[2]] - mesh.rest[t[0]]).z(), 0);
}

TEST_P(Rectangle, BoundaryVerticesLieExactlyOnTheOutlineAndNoOthers) {
  const ClothMesh mesh = make_rectangle(kLength, kWidth, 1000, GetParam(), 1);
  const std::set<int> boundary = test::boundary_vertices(mesh);
  for (int v = 0; v < mesh.vertices(); ++v) {
    const double x = mesh.rest[v].x(), y = mesh.rest[v].y();
    EXPECT_EQ(boundary.count(v) > 0, x == 0 || x == kLength || y == 0 || y == kWidth) << x << " " << y;
    EXPECT_EQ(mesh.rest[v].z(), 0);
  }
}

TEST_P(Rectangle, TriangleCountIsWithinHalfARowOfTheRequest) {
  for (const int n : test::kMeshSizes) {
    if (n < 20) continue;  // of a few triangles, whole cells cannot make any number
    const int made = make_rectangle(kLength, kWidth, n, GetParam(), 1).faces();
    EXPECT_NEAR(made, n, stated_share(n) * n) << n;
  }
}

TEST_P(Rectangle, AnglesStayWideForFiftyTrianglesAndMore) {
  const double least = GetParam() == MeshFamily::random        ? 18
                       : GetParam() == MeshFamily::equilateral ? 25
                                                               : 35;
  for (const int n : test::kMeshSizes) {
    if (n < 50) continue;
    EXPECT_GT(test::least_angle(make_rectangle(kLength, kWidth, n, GetParam(), 1)), least) << n;
  }
}

TEST_P(Rectangle, NarrowStripKeepsOneRowOfCells) {
  const ClothMesh mesh = make_rectangle(1, 0.01, 200, GetParam(), 1);
  EXPECT_NEAR(mesh.faces(), 200, 2);
  EXPECT_NEAR(test::total_area(mesh), 0.01, test::kSumRounding * 0.01);
}

TEST_P(Rectangle, IsTheSameMeshTwice) {
  const ClothMesh a = make_rectangle(kLength, kWidth, 1000, GetParam(), 9);
  EXPECT_EQ(test::fingerprint(a), test::fingerprint(make_rectangle(kLength, kWidth, 1000, GetParam(), 9)));
}

TEST(Grid, HasExactlyTheCellsAskedFor) {
  for (const MeshFamily family : {MeshFamily::aligned, MeshFamily::flipped, MeshFamily::unionjack}) {
    const ClothMesh mesh = make_grid(kLength, kWidth, 7, 4, family, 0);
    EXPECT_EQ(mesh.vertices(), 8 * 5);
    EXPECT_EQ(mesh.faces(), 2 * 7 * 4);
  }
  EXPECT_EQ(make_grid(kLength, kWidth, 7, 4, MeshFamily::random, 0).faces(), 2 * 7 * 4);
  for (const MeshFamily family : {MeshFamily::equilateral, MeshFamily::aligned45})
    EXPECT_EQ(make_grid(kLength, kWidth, 7, 4, family, 0).faces(), 4 * (2 * 7 + 1));
}

// Number of diagonals that rise (dx dy > 0) among the edges that are neither level nor upright.
int rising(const ClothMesh& mesh) {
  int count = 0;
  for (const Edge& e : mesh.edge) {
    const Eigen::Vector3d d = mesh.rest[e.p3] - mesh.rest[e.p2];
    count += d.x() * d.y() > 1e-12;
  }
  return count;
}

TEST(Grid, DiagonalsAreAllRisingAllFallingOrHalfAndHalf) {
  EXPECT_EQ(rising(make_grid(1, 1, 6, 4, MeshFamily::aligned, 0)), 24);
  EXPECT_EQ(rising(make_grid(1, 1, 6, 4, MeshFamily::flipped, 0)), 0);
  EXPECT_EQ(rising(make_grid(1, 1, 6, 4, MeshFamily::unionjack, 0)), 12);
}

TEST(Grid, EquilateralInteriorIsEquilateral) {
  const ClothMesh mesh = make_grid(8, 6 * std::sqrt(0.75), 8, 6, MeshFamily::equilateral, 0);
  int equilateral = 0;
  for (const double area : mesh.face_area) equilateral += std::abs(area - std::sqrt(3.0) / 4) < 1e-14;
  EXPECT_EQ(equilateral, mesh.faces() - 2 * 6);  // all but two half triangles per row
}

TEST(RandomRectangle, DependsOnItsSeed) {
  EXPECT_NE(test::fingerprint(make_rectangle(1, 1, 200, MeshFamily::random, 1)),
            test::fingerprint(make_rectangle(1, 1, 200, MeshFamily::random, 2)));
}

// Own generator mapping, own circle and exact predicates: no library's or processor's last bit comes in.
TEST(RandomRectangle, HasTheSameBitsOnEveryMachine) {
  EXPECT_EQ(test::fingerprint(make_rectangle(1, 0.75, 1000, MeshFamily::random, 7)), 1676399628281410506u);
}

TEST(RectangleRequest, ImpossibleOnesAreRefusedByName) {
  const auto refusal = [](double length, double width, int triangles) {
    return test::refusal([&] { make_rectangle(length, width, triangles, MeshFamily::aligned, 0); });
  };
  EXPECT_EQ(refusal(-1, 1, 10), "rectangle mesh: length = -1 m must be > 0");
  EXPECT_EQ(refusal(1, NAN, 10), "rectangle mesh: width = nan m must be > 0");
  EXPECT_EQ(refusal(1, 1, 1), "rectangle mesh: triangles = 1 must be 2 to 10000000");
  EXPECT_EQ(refusal(1, 1, 2000000000), "rectangle mesh: triangles = 2000000000 must be 2 to 10000000");
  EXPECT_EQ(test::refusal([] { make_grid(1, 1, 3, 0, MeshFamily::aligned, 0); }),
            "rectangle mesh: 3 x 0 cells must be at least 1 x 1 and at most 10000000");
}

}  // namespace
}  // namespace hysteron
