// Tubes: closed along their seam, round, and refused where the seam does not meet.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

constexpr double kTubeLength = 0.3, kTubeRadius = 0.05;

class Tube : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(Families, Tube,
                         testing::Values(MeshFamily::aligned, MeshFamily::unionjack, MeshFamily::random),
                         test::CaseName());

TEST_P(Tube, IsOpenAtItsTwoEndsOnly) {
  const ClothMesh mesh = make_tube(kTubeLength, kTubeRadius, 2000, GetParam(), 1);
  EXPECT_EQ(test::euler_characteristic(mesh), 0);
  for (const int v : test::boundary_vertices(mesh)) {
    const double x = mesh.rest[v].x();
    EXPECT_LT(std::min(std::abs(x), std::abs(x - kTubeLength)), 1e-12);
  }
}

TEST_P(Tube, LiesOnTheCylinderWithItsFrontOutside) {
  const ClothMesh mesh = make_tube(kTubeLength, kTubeRadius, 2000, GetParam(), 1);
  for (const Eigen::Vector3d& x : mesh.rest) EXPECT_NEAR(x.tail<2>().norm(), kTubeRadius, 1e-12);
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto& t = mesh.face[f];
    const Eigen::Vector3d a = mesh.rest[t[0]], b = mesh.rest[t[1]], c = mesh.rest[t[2]];
    EXPECT_GT((b - a).cross(c - a).dot(Eigen::Vector3d(0, a.y() + b.y() + c.y(), a.z() + b.z() + c.z())), 0);
  }
  // An inscribed polygon of n sides is shorter than its circle by pi^2/(6 n^2), n about 30 here.
  EXPECT_NEAR(test::total_area(mesh) / (2 * std::numbers::pi * kTubeRadius * kTubeLength), 1, 5e-3);
}

TEST(TubeSeam, OfRowsThatAreShiftedIsRefused) {
  int refused = 0;
  for (int triangles : {400, 500, 600, 700, 800}) {
    const std::string reason =
        test::refusal([&] { make_tube(kTubeLength, kTubeRadius, triangles, MeshFamily::equilateral, 1); });
    if (reason == test::kAccepted) continue;
    EXPECT_TRUE(test::says(reason, "unionjack"));
    ++refused;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace hysteron
