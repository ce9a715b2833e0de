#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using test::kFamilies;

constexpr double kDiscRadius = 0.15;  // A unit vector is normalised to 1 ulp or so, then scaled.
constexpr double kOnCircle = 1e-15;
// The docstring's promise about the triangle count.
constexpr double kStatedFraction = 0.05;
constexpr double kStatedCount = 8;

class Disc : public testing::TestWithParam<MeshFamily> {
 protected:
  static ClothMesh disc(int triangles) { return make_disc(kDiscRadius, triangles, GetParam(), 1); }
};
INSTANTIATE_TEST_SUITE_P(Families, Disc, testing::ValuesIn(kFamilies), test::CaseName());

TEST_P(Disc, HasEulerCharacteristicOfADisc) {
  for (const int n : test::kMeshSizes) EXPECT_EQ(test::euler_characteristic(disc(n)), 1) << n;
}

TEST_P(Disc, BoundaryVerticesLieOnTheCircleAndAllOthersInside) {
  for (const int n : test::kMeshSizes) {
    const ClothMesh mesh = disc(n);
    const std::set<int> boundary = test::boundary_vertices(mesh);
    for (int v = 0; v < mesh.vertices(); ++v) {
      if (boundary.count(v))
        EXPECT_NEAR(mesh.rest[v].norm() / kDiscRadius, 1, kOnCircle) << n;
      else
        EXPECT_LT(mesh.rest[v].norm(), kDiscRadius) << n;
      EXPECT_EQ(mesh.rest[v].z(), 0);
    }
  }
}

TEST_P(Disc, AreaIsThatOfTheRegularPolygonOfItsBoundary) {
  for (const int n : test::kMeshSizes) {
    const ClothMesh mesh = disc(n);
    const double b = static_cast<double>(test::boundary_vertices(mesh).size());
    const double polygon = 0.5 * b * kDiscRadius * kDiscRadius * std::sin(2 * std::numbers::pi / b);
    EXPECT_NEAR(test::total_area(mesh), polygon, test::kSumRounding * polygon) << n;
  }
}

TEST_P(Disc, EveryTriangleShowsItsFrontToPlusZ) {
  const ClothMesh mesh = disc(1000);
  for (const auto& t : mesh.face)
    EXPECT_GT((mesh.rest[t[1]] - mesh.rest[t[0]]).cross(mesh.rest[t[2]] - mesh.rest[t[0]]).z(), 0);
}

TEST_P(Disc, TriangleCountIsWithinTheStatedShare) {
  for (int n = 2; n <= 20000; n += 1 + n / 4)
    EXPECT_NEAR(disc(n).faces(), n, std::max(kStatedFraction * n, kStatedCount));
}

TEST_P(Disc, HasNoSliversAtAnySize) {
  const double least = GetParam() == MeshFamily::random ? 18 : 28;  // degrees
  for (int n = 50; n <= 20000; n = n * 5 / 4) EXPECT_GT(test::least_angle(disc(n)), least) << n;
}

TEST_P(Disc, FewTrianglesStillMakeAMesh) {
  for (int n = 2; n < 50; ++n) {
    const ClothMesh mesh = disc(n);
    EXPECT_NEAR(mesh.faces(), n, kStatedCount);
    EXPECT_GT(test::least_angle(mesh), 15) << n;
  }
}

TEST_P(Disc, ScalesWithItsRadius) {
  const ClothMesh small = make_disc(1, 500, GetParam(), 1), large = make_disc(4, 500, GetParam(), 1);
  ASSERT_EQ(small.face, large.face);
  for (int v = 0; v < small.vertices(); ++v) EXPECT_EQ(4 * small.rest[v], large.rest[v]);
}

// Lattice triangles have one shape; only those at the ring differ.
TEST(LatticeDisc, MostTrianglesBelongToTheFamilysLattice) {
  for (const MeshFamily family : kFamilies) {
    if (family == MeshFamily::random) continue;
    const ClothMesh mesh = make_disc(1, 20000, family, 0);
    std::vector<double> areas = mesh.face_area;
    std::nth_element(areas.begin(), areas.begin() + areas.size() / 2, areas.end());
    const double median = areas[areas.size() / 2];
    int alike = 0;
    for (const double area : mesh.face_area) alike += std::abs(area - median) < 1e-9 * median;
    EXPECT_GT(alike, 0.95 * mesh.faces()) << enum_name(family);
  }
}

// The shares of rising and falling diagonals among edges at 45 degrees, away from the ring.
std::array<int, 2> diagonals(const ClothMesh& mesh) {
  std::array<int, 2> count{0, 0};
  for (const Edge& e : mesh.edge) {
    const Eigen::Vector3d d = mesh.rest[e.p3] - mesh.rest[e.p2];
    if (std::max(mesh.rest[e.p2].norm(), mesh.rest[e.p3].norm()) > 0.85) continue;
    if (std::abs(std::abs(d.x()) - std::abs(d.y())) < 1e-9) ++count[d.x() * d.y() > 0];
  }
  return count;
}

TEST(LatticeDisc, DiagonalsFollowTheFamily) {
  const auto aligned = diagonals(make_disc(1, 2000, MeshFamily::aligned, 0));
  EXPECT_EQ(aligned[0], 0);
  EXPECT_GT(aligned[1], 500);
  const auto flipped = diagonals(make_disc(1, 2000, MeshFamily::flipped, 0));
  EXPECT_EQ(flipped[1], 0);
  EXPECT_EQ(flipped[0], aligned[1]);
  const auto jack = diagonals(make_disc(1, 2000, MeshFamily::unionjack, 0));
  EXPECT_NEAR(jack[0], jack[1], 0.05 * jack[0]);
}

TEST(RandomDisc, DependsOnItsSeed) {
  EXPECT_NE(test::fingerprint(make_disc(1, 200, MeshFamily::random, 1)),
            test::fingerprint(make_disc(1, 200, MeshFamily::random, 2)));
}

TEST(RandomDisc, HasTheSameBitsOnEveryMachine) {
  EXPECT_EQ(test::fingerprint(make_disc(1, 1000, MeshFamily::random, 7)), 11145039678376973896u);
}

TEST(RandomDisc, AnglesStayWideForManySeeds) {
  for (unsigned seed = 0; seed < 40; ++seed)
    EXPECT_GT(test::least_angle(make_disc(1, 1000, MeshFamily::random, seed)), 18) << seed;
}

TEST(DiscRequest, ImpossibleOnesAreRefusedByName) {
  EXPECT_EQ(test::refusal([] { make_disc(0, 100, MeshFamily::aligned, 0); }),
            "disc mesh: radius = 0 m must be > 0");
  EXPECT_EQ(test::refusal([] { make_disc(1, 0, MeshFamily::random, 0); }),
            "disc mesh: triangles = 0 must be 2 to 10000000");
}

}  // namespace
}  // namespace hysteron
