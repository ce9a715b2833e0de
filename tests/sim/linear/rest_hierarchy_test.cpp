// Coarser vertex sets on the rest shape.
#include "sim/linear/rest_hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/linear/block_rows.h"
#include "tests/sim/base/case_name.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;

// Positions of a level's nodes, which are some of the finer ones.
std::vector<Vector3d> positions(const RestLevel& level, const std::vector<Vector3d>& finer) {
  std::vector<Vector3d> result(level.nodes);
  for (std::size_t i = 0; i < finer.size(); ++i)
    if (level.finer[i].weight[0] == 1) result[level.finer[i].node[0]] = finer[i];
  return result;
}

Vector3d interpolated(const Interpolation& from, const std::vector<Vector3d>& value) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) sum += from.weight[k] * value[from.node[k]];
  return sum;
}

std::vector<char> none(const ClothMesh& mesh) { return std::vector<char>(mesh.vertices(), 0); }

class EveryFamily : public testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(Meshes, EveryFamily,
                         testing::Values(MeshFamily::aligned, MeshFamily::flipped, MeshFamily::unionjack,
                                         MeshFamily::equilateral, MeshFamily::random),
                         test::CaseName());

TEST_P(EveryFamily, LevelsShrinkToSomeDozenNodes) {
  const ClothMesh mesh = make_rectangle(0.5, 0.3, 20000, GetParam(), 1);
  const RestHierarchy hierarchy = make_rest_hierarchy(mesh, neighbours_in(mesh), none(mesh));
  ASSERT_GE(hierarchy.size(), 2u);
  int finer = mesh.vertices();
  for (const RestLevel& level : hierarchy) {
    EXPECT_LT(level.nodes, finer / 4);
    EXPECT_EQ(static_cast<int>(level.finer.size()), finer);
    EXPECT_LT(level.pattern.item.size(), 25u * level.nodes);  // two rings of a plane triangulation are 18
    finer = level.nodes;
  }
  EXPECT_LE(finer, 64);
}

TEST_P(EveryFamily, FlatClothInterpolatesLinearFieldsExactly) {
  const ClothMesh mesh = make_rectangle(0.5, 0.3, 5000, GetParam(), 1);
  constexpr double kRounding = 1e-10;  // a vertex outside by less than 1e-9 of a triangle counts as inside
  std::vector<Vector3d> finer = mesh.rest;
  for (const RestLevel& level : make_rest_hierarchy(mesh, neighbours_in(mesh), none(mesh))) {
    const std::vector<Vector3d> coarse = positions(level, finer);
    for (std::size_t i = 0; i < finer.size(); ++i) {
      EXPECT_LT((interpolated(level.finer[i], coarse) - finer[i]).norm(), kRounding) << i;
      for (double w : level.finer[i].weight) EXPECT_GE(w, 0);
    }
    finer = coarse;
  }
}

// On a cylinder of radius R the chord between nodes H apart lies H^2/(8 R) inside.
TEST(RestHierarchy, FollowsCurvedCloth) {
  constexpr double kRadius = 0.1;
  ClothMesh mesh = make_rectangle(0.5, 0.3, 5000, MeshFamily::random, 1);
  const double edge = std::sqrt(4 / std::sqrt(3.0) * 0.5 * 0.3 / mesh.faces());
  for (Vector3d& x : mesh.rest)
    x = {kRadius * std::sin(x.x() / kRadius), x.y(), -kRadius * std::cos(x.x() / kRadius)};
  build_topology(mesh, "cylinder");
  const RestHierarchy hierarchy = make_rest_hierarchy(mesh, neighbours_in(mesh), none(mesh));
  const std::vector<Vector3d> coarse = positions(hierarchy[0], mesh.rest);
  const double spacing = 5 * edge;  // no coarse triangle's side is longer
  for (int i = 0; i < mesh.vertices(); ++i)
    EXPECT_LT((interpolated(hierarchy[0].finer[i], coarse) - mesh.rest[i]).norm(),
              spacing * spacing / (8 * kRadius))
        << i;
}

// Tilting the whole cloth bends nothing; a bent one's energy is at least the plate's, (w'')^2/2 per area.
TEST(Plate, ResistsBendingAndNothingElse) {
  const ClothMesh mesh = make_rectangle(0.5, 0.3, 5000, MeshFamily::random, 1);
  std::vector<Vector3d> node = mesh.rest;
  for (const RestLevel& level : make_rest_hierarchy(mesh, neighbours_in(mesh), none(mesh))) {
    node = positions(level, node);
    const auto energy = [&](const auto& w) {
      double sum = 0;
      for (int i = 0; i < level.nodes; ++i) {
        sum += w(node[i]) * level.plate_diagonal[i] * w(node[i]) / 2;
        for (int j = level.pattern.start[i]; j < level.pattern.start[i + 1]; ++j)
          sum += w(node[i]) * level.plate_off_diagonal[j] * w(node[level.pattern.item[j]]) / 2;
      }
      return sum;
    };
    const double bent = energy([](const Vector3d& x) { return x.x() * x.x() / 2; });
    const double tilted = energy([](const Vector3d& x) { return 1 + x.x() - 2 * x.y(); });
    constexpr double kRounding = 1e-6, kCoarse = 0.7;  // nodes' hats end at the boundary
    EXPECT_GT(bent, kCoarse * 0.5 * 0.3 / 2);
    EXPECT_LT(std::abs(tilted), kRounding * bent);
  }
}

TEST(RestHierarchy, LeavesSmallClothAlone) {
  const ClothMesh mesh = make_rectangle(0.1, 0.1, 18, MeshFamily::aligned, 1);
  EXPECT_TRUE(make_rest_hierarchy(mesh, neighbours_in(mesh), none(mesh)).empty());
}

}  // namespace
}  // namespace hysteron
