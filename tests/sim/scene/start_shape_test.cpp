// Cloth that is flat at rest and starts otherwise: knotted, pleated, or as several copies.
#include "sim/scene/start_shape.h"

#include <cmath>

#include "sim/mesh/intersections.h"
#include "sim/scene/cloth.h"
#include "tests/sim/base/case_name.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

Scene strip_in(const std::string& start, double length, double width, double radius) {
  Scene scene;
  scene.mesh = "random";
  scene.triangles = 2000;
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.start = start;
  scene.cloth.length = length;
  scene.cloth.width = width;
  scene.cloth.radius = radius;
  return scene;
}

Scene knotted() { return strip_in("knot", 0.8, 0.008, 0.04); }

Scene pleated() {
  Scene scene = strip_in("pleats", 0.4, 0.05, 0.005);
  scene.cloth.pleats = 6;
  return scene;
}

Scene ten_sheets() {
  Scene scene;
  scene.mesh = "random";
  scene.triangles = 1000;
  scene.cloth.shape = ClothOutline::square;
  scene.cloth.length = 0.2;
  scene.cloth.copies = 10;
  scene.cloth.copy_offset = {0, 0, 0.012};
  scene.cloth.copy_turn = 20;
  scene.cloth.copy_scatter = 0.01;
  return scene;
}

// Returns the largest strain of an edge, over its length at rest.
double largest_strain(const Cloth& cloth) {
  double largest = 0;
  for (const Edge& e : cloth.mesh.edge) {
    const double rest = (cloth.mesh.rest[e.p3] - cloth.mesh.rest[e.p2]).norm();
    largest = std::max(largest, std::abs((cloth.start[e.p3] - cloth.start[e.p2]).norm() / rest - 1));
  }
  return largest;
}

// Returns the distance of the nearest two vertices that are far from each other on the flat cloth.
double nearest_layers(const Cloth& cloth, double far) {
  double nearest = INFINITY;
  for (int i = 0; i < cloth.mesh.vertices(); ++i)
    for (int j = 0; j < i; ++j)
      if ((cloth.mesh.rest[i] - cloth.mesh.rest[j]).norm() > far)
        nearest = std::min(nearest, (cloth.start[i] - cloth.start[j]).norm());
  return nearest;
}

TEST(StartShape, OfAKnotHardlyStretchesTheStripAndKeepsItsLayersApart) {
  const Cloth cloth = make_cloth(knotted());
  EXPECT_LT(largest_strain(cloth), 0.01);
  EXPECT_TRUE(intersecting_triangles(cloth.mesh.face, cloth.start).empty());
  EXPECT_GT(nearest_layers(cloth, 0.03), 2 * Fabric{}.thickness);
}

TEST(StartShape, OfAKnotEndsInTwoStraightTails) {
  const Scene scene = knotted();
  const Cloth cloth = make_cloth(scene);
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), last = Eigen::Vector3d::Zero();
  for (int i = 0; i < cloth.mesh.vertices(); ++i) {
    if (cloth.mesh.rest[i].x() == 0) first = cloth.start[i];
    if (cloth.mesh.rest[i].x() == scene.cloth.length) last = cloth.start[i];
  }
  const double tails = scene.cloth.length - knot_length(scene.cloth.width, scene.cloth.radius);
  EXPECT_GT(std::abs((last - first).x()), tails);
  EXPECT_LT(std::abs((last - first).x()), scene.cloth.length / 2);
}

TEST(StartShape, OfPleatsHasTheirLayersAtTwiceTheRadius) {
  const Scene scene = pleated();
  const Cloth cloth = make_cloth(scene);
  EXPECT_LT(largest_strain(cloth), 0.25);  // chords of the turns
  EXPECT_TRUE(intersecting_triangles(cloth.mesh.face, cloth.start).empty());
  double top = 0;
  for (const Eigen::Vector3d& x : cloth.start) top = std::max(top, x.z());
  EXPECT_NEAR(top, 2 * scene.cloth.radius * (scene.cloth.pleats - 1), 1e-12);
}

TEST(StartShape, OfCopiesIsTheSameMeshTimesTheirNumberAndFreeOfCrossings) {
  const Scene scene = ten_sheets();
  const Cloth cloth = make_cloth(scene);
  Scene alone = scene;
  alone.cloth.copies = 1;
  alone.triangles = scene.triangles / 10;
  const Cloth one = make_cloth(alone);
  EXPECT_EQ(cloth.mesh.vertices(), 10 * one.mesh.vertices());
  EXPECT_EQ(cloth.mesh.faces(), 10 * one.mesh.faces());
  EXPECT_TRUE(intersecting_triangles(cloth.mesh.face, cloth.start).empty());
  EXPECT_LT(largest_strain(cloth), 1e-12);
  Scene again = scene;
  again.seed = scene.seed + 1;
  EXPECT_NE(make_cloth(again).start, cloth.start);
}

struct BadStart {
  const char* name;
  Scene (*scene)();
  void (*spoil)(Scene&);
  std::vector<const char*> naming;
};

void PrintTo(const BadStart& bad, std::ostream* out) { *out << bad.name; }

class BadStartShape : public testing::TestWithParam<BadStart> {};

TEST_P(BadStartShape, IsRefusedInOneLineThatNamesKeyValueAndRange) {
  const std::string reason = test::refusal([&] {
    Scene scene = GetParam().scene();
    GetParam().spoil(scene);
    check_start_shape(scene);
    make_cloth(scene);
  });
  for (const char* part : GetParam().naming) EXPECT_TRUE(test::says(reason, part));
}

const BadStart kBadStarts[] = {
    {"KnotOfTightLoops", knotted, [](Scene& s) { s.cloth.radius = 0.01; }, {"cloth.radius = 0.01 m", ">="}},
    {"KnotInAShortStrip", knotted, [](Scene& s) { s.cloth.length = 0.2; }, {"cloth.length = 0.2 m", ">="}},
    {"KnotInADisc",
     knotted,
     [](Scene& s) { s.cloth.shape = ClothOutline::disc; },
     {"cloth.start = knot", "strip", "disc"}},
    {"PleatsThinnerThanCloth",
     pleated,
     [](Scene& s) { s.cloth.radius = 1e-5; },
     {"cloth.radius = 1e-05 m", "fabric.thickness"}},
    {"PleatsLongerThanCloth",
     pleated,
     [](Scene& s) { s.cloth.pleats = 60; },
     {"cloth.length = 0.4 m", "cloth.pleats = 60"}},
    {"CopiesTooNear",
     ten_sheets,
     [](Scene& s) {
       s.cloth.copy_offset = {0, 0, 3e-4};
     },
     {"cloth.copy-offset", "3e-04 m"}},
    {"CopiesWithoutTriangles",
     ten_sheets,
     [](Scene& s) { s.triangles = 12; },
     {"triangles = 12", "cloth.copies = 10"}}};

INSTANTIATE_TEST_SUITE_P(Starts, BadStartShape, testing::ValuesIn(kBadStarts), test::CaseName());

// One answer for pins, metrics and their warnings: a level cloth's height is where its file has it.
TEST(NearestVertex, IsThatOfTheFlatClothAndSaysHowFarAPointLiesBesideIt) {
  constexpr double kRounding = 1e-15;  // [m]
  const ClothMesh mesh = make_grid(0.2, 0.1, 2, 1, MeshFamily::unionjack, 1);
  for (int i = 0; i < mesh.vertices(); ++i) {
    const NearestVertex above = nearest_vertex(mesh, mesh.rest[i] + Eigen::Vector3d(0.001, 0.002, 5));
    EXPECT_EQ(above.vertex, i);
    EXPECT_EQ(above.beside, 0) << "a point above the cloth is not beside it";
  }
  const NearestVertex beside = nearest_vertex(mesh, {0.2 + 0.3, 0.1 + 0.4, 0});
  EXPECT_NEAR((mesh.rest[beside.vertex] - Eigen::Vector3d(0.2, 0.1, 0)).norm(), 0, kRounding);
  EXPECT_NEAR(beside.beside, 0.5, kRounding);
}

}  // namespace
}  // namespace hysteron
