// Starts that contact cannot go on from are refused, with their place; others are not.
#include "sim/contact/start_checks.h"

#include <gtest/gtest.h>

#include "sim/base/enum_names.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/self_contact.h"
#include "sim/mesh/intersections.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::kAccepted;
using test::says;
using test::Trial;

// Returns the message of make_simulation(), through which every experiment goes.
std::string start_refusal(const Trial& trial) {
  return test::refusal([&] { trial.simulation(); });
}

TEST(Start, OfClothThickerThanItIsLongIsRefused) {
  Scene scene = test::free_square(60);
  scene.self_contact = true;
  const double diagonal = std::sqrt(2.0) * scene.cloth.length;
  for (double thickness : {1.001 * diagonal, 100.0}) {
    scene.fabric.thickness = thickness;
    EXPECT_TRUE(says(start_refusal(Trial(scene)),
                     "fabric.thickness = ", " mm (default) must be < 282.8 mm, the cloth's diagonal"));
  }
  scene.fabric.thickness = 0.99 * diagonal;
  EXPECT_EQ(start_refusal(Trial(scene)), kAccepted);
}

TEST(Start, ThatPassesThroughItselfIsRefusedWithTheTriangles) {
  Trial trial = test::two_sheets(1e-3, 60);
  for (int i : test::upper_vertices(trial))
    trial.cloth.start[i].z() -= 0.1 * (trial.cloth.start[i].x() - 0.7 * test::kUpperSide);
  const auto pairs = intersecting_triangles(trial.cloth.mesh.face, trial.cloth.start);
  EXPECT_TRUE(says(start_refusal(trial),
                   "self-contact: the cloth passes through itself at the start: triangles " +
                       std::to_string(pairs[0].first) + " and " + std::to_string(pairs[0].second),
                   "(" + std::to_string(pairs.size()) + " pairs in all)"));
  trial.scene.self_contact = false;  // then nothing keeps it apart later either
  EXPECT_EQ(start_refusal(trial), kAccepted);
}

// Returns the least distance of pairs that are far apart at rest.
double least_start_distance(double thickness) {
  SelfPair<double> pair{};
  pair.activation_distance = thickness;
  return least_distance(pair);
}

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", 1e3 * metres);
  return text;
}

TEST(Start, WithLayersNearerThanAnyStepMayBringThemIsRefusedWithTheirDistance) {
  const double least = least_start_distance(Fabric{}.thickness);
  constexpr double kJust = 1e-3;  // relative: beyond the rounding of the distance
  EXPECT_TRUE(says(start_refusal(test::two_sheets(0.8 * least, 60)),
                   "self-contact: the cloth starts too near to itself",
                   "are " + millimetres(0.8 * least) + " apart", "more than " + millimetres(least),
                   "fabric.thickness = 0.497 mm"));
  test::two_sheets((1 + kJust) * least, 60).after(2);
}

// Layers that just touch press on nothing: without weight they stay where they are.
TEST(Start, OfKissingLayersIsAtRest) {
  Trial trial = test::two_sheets(Fabric{}.thickness, 60);
  trial.scene.gravity.setZero();
  const auto simulation = trial.after(10);
  constexpr double kRounding = 1e-12;  // [m]
  EXPECT_LT(test::farthest(simulation->positions(), trial.cloth.start), kRounding);
  EXPECT_EQ(simulation->ledger().contact, 0);
}

// Pressed layers push each other off, with no more than what their barrier had stored.
TEST(Start, OfPressedLayersPushesThemApartWithTheEnergyOfTheBarrier) {
  Trial trial = test::two_sheets(0.7 * Fabric{}.thickness, 60);
  trial.scene.gravity.setZero();
  const auto simulation = trial.simulation();
  const double stored = simulation->ledger().contact;
  EXPECT_GT(stored, 0);
  for (int k = 0; k < 10; ++k) {
    simulation->advance(1);
    EXPECT_LE(simulation->ledger().kinetic, stored) << k;
  }
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty());
  const auto x = simulation->positions();
  for (int i : test::upper_vertices(trial)) EXPECT_GT(x[i].z(), Fabric{}.thickness);
}

// Cloth that is thicker than its edges are long feels its neighbours from half their distance at rest on, so
// that the flat cloth is at rest, and layers touch at their thickness or less.
TEST(Start, OfAThicknessBeyondTheMeshIsAtRestOnTheFlatCloth) {
  Scene scene = test::free_square(200);  // edges of 2 cm
  scene.fabric.thickness = 0.05;
  scene.self_contact = true;
  scene.integrator = Integrator::implicit;
  scene.gravity.setZero();
  const Trial trial(scene);
  Cpu cpu(1);
  SelfContact<double, Cpu> contact(cpu, trial.cloth.mesh, scene);
  const std::vector<Vector3d> still(trial.cloth.start.size(), Vector3d::Zero());
  const std::vector<char> held(still.size());
  EXPECT_EQ(contact.prepare(trial.cloth.start.data(), still.data(), held.data()), 1);
  EXPECT_GT(contact.pairs(), 0);  // looked at, but none within its activation distance
  EXPECT_EQ(contact.stored_energy(trial.cloth.start.data()), 0);
  const auto x = trial.after(5)->positions();
  constexpr double kRounding = 1e-12;  // [m]
  EXPECT_LT(test::farthest(x, trial.cloth.start), kRounding);
}

// It still does what it stands for: a sheet that lands stays above the other one.
TEST(Start, OfAThicknessBeyondTheMeshStillKeepsLayersApart) {
  Trial trial = test::two_sheets(2e-2, 60);  // edges of 1 cm
  trial.scene.fabric.thickness = 8e-3;
  const auto simulation = trial.after(40);
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty());
  for (int i : test::upper_vertices(trial)) EXPECT_GT(simulation->positions()[i].z(), 0);
}

struct RestingSolid {
  ObstacleKind kind;
  Vector3d center;
  double depth;  // of the cloth's deepest vertex below its surface [m]
};

// A flat sheet of 0.2 m whose middle vertex is the one at (0.1, 0.1, 0).
Trial sheet_with(const RestingSolid& solid) {
  Scene scene = test::free_square(200);
  scene.mesh = "aligned";
  Obstacle o = test::box_at(solid.center, {0.05, 0.05, 0.05});
  o.kind = solid.kind;
  o.radius = 0.05;
  o.rim = 0;
  scene.obstacle = {test::ground_at(-1), o};
  return Trial(scene);
}

TEST(Start, InsideAnObstacleIsRefusedWithObstacleVertexPlaceAndDepth) {
  for (const RestingSolid& solid : {RestingSolid{ObstacleKind::sphere, {0.1, 0.1, -0.03}, 0.02},
                                    RestingSolid{ObstacleKind::box, {0.1, 0.1, -0.04}, 0.01},
                                    RestingSolid{ObstacleKind::cylinder, {0.1, 0.1, -0.04}, 0.01},
                                    RestingSolid{ObstacleKind::ground, {0, 0, 0.004}, 0.004},
                                    RestingSolid{ObstacleKind::capsule, {0.1, 0.1, -0.09}, 0.01}}) {
    const Trial trial = sheet_with(solid);
    const auto set = obstacles_during<double>(trial.scene.obstacle, 0.3, 0, 0);
    const Immersion found = deepest(set, trial.cloth.start, std::vector<char>(trial.cloth.start.size()));
    EXPECT_NEAR(found.depth, solid.depth, 1e-12) << enum_name(solid.kind);
    EXPECT_TRUE(says(
        start_refusal(trial), "at the start " + vertex_text(found.vertex, trial.cloth.start[found.vertex]),
        millimetres(solid.depth), std::string("inside obstacle[1] (") + enum_name(solid.kind) + ")",
        "of " + std::to_string(found.count) + " such vertices"));
  }
}

TEST(Start, BetweenObstaclesThatOverlapAroundItIsRefused) {
  Trial trial = sheet_with({ObstacleKind::box, {0.1, 0.1, -0.04}, 0});
  trial.scene.obstacle[0] = trial.scene.obstacle[1];
  trial.scene.obstacle[0].center.z() = 0.03;
  EXPECT_TRUE(says(start_refusal(trial), "obstacle: at the start vertex ", "20 mm inside obstacle[0] (box)"));
}

// A hollow sphere of 5 cm about the middle of the sheet: its corners are 10 sqrt(2) cm away.
TEST(Start, OutsideAHollowSphereIsRefused) {
  EXPECT_TRUE(says(start_refusal(sheet_with({ObstacleKind::hollow, {0.1, 0.1, 0}, 0})),
                   "91.4 mm outside obstacle[1] (hollow)", "vertex 0 at (0, 0, 0) m"));
}

TEST(Start, WithinTheShellOfAnObstacleIsFineAndItsSurfaceIsTheLimit) {
  const double t = Fabric{}.thickness;
  for (double height : {0.0, 0.5, 1.0})  // of the cloth's middle surface above the ground, in thicknesses
    EXPECT_EQ(start_refusal(sheet_with({ObstacleKind::ground, {0, 0, -height * t}, 0})), kAccepted) << height;
  EXPECT_NE(start_refusal(sheet_with({ObstacleKind::ground, {0, 0, 0.01 * t}, 0})), kAccepted);
}

TEST(Start, OfHeldVerticesInsideAnObstacleIsFine) {
  Trial trial = sheet_with({ObstacleKind::sphere, {0.1, 0.1, -0.03}, 0});
  trial.scene.pin = {test::pin_in({0.055, 0.055, -1}, {0.145, 0.145, 1})};
  trial = Trial(trial.scene);
  trial.after(10);
  trial.scene.pin[0].until = 0.005;  // let go where the sphere is
  const std::string failure = test::refusal([&] { trial.after(10); }, 3);
  EXPECT_TRUE(says(failure, "inside obstacle[1] (sphere)", "at t = 0.005 s a pin releases the cloth"));
}

// An obstacle that comes later cannot be known at the start.
TEST(Obstacle, ThatAppearsWhereTheClothIsEndsTheRunWithPlaceAndTime) {
  for (const char* integrator : {"semi-implicit", "implicit"}) {
    Trial trial = sheet_with({ObstacleKind::box, {0.1, 0.1, -0.04}, 0});
    trial.scene.integrator = value_named<Integrator>(integrator);
    trial.scene.gravity.setZero();
    trial.scene.obstacle[1].from = 0.02;
    const auto simulation = trial.after(20);
    const std::string failure = test::refusal([&] { simulation->advance(1); }, 3);
    EXPECT_TRUE(says(failure, "at t = 0.02 s", "10 mm inside obstacle[1] (box)", "vertex ", " at ("))
        << integrator;
  }
}

TEST(Obstacles, AreAtMostTwelve) {
  Trial trial = sheet_with({ObstacleKind::box, {0.1, 0.1, -0.1}, 0});
  trial.scene.obstacle.resize(kMaxObstacles + 1, trial.scene.obstacle[0]);
  EXPECT_TRUE(says(start_refusal(trial), "13 obstacles, at most 12"));
}

}  // namespace
}  // namespace hysteron
