// Obstacles and cloth that would pass through each other in one step do not: thin ones, fast ones, and ones
// that turn or close.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "sim/base/enum_names.h"
#include "sim/contact/sweep.h"
#include "sim/mesh/intersections.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;

constexpr double kStep = 1.0 / 60;
constexpr double kHalf = 5e-4;      // of a plate of 1 mm [m]
constexpr double kSweptSide = 0.1;  // of the cloth [m]
constexpr double kSweptClosed = 1e-9;

// Returns a square in the plane z = 0 around the origin, without weight.
Scene sheet(const std::string& integrator, int triangles = 100) {
  Scene scene = test::free_square(triangles);
  scene.cloth.length = kSweptSide;
  scene.cloth.position = {-kSweptSide / 2, -kSweptSide / 2, 0};
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.self_contact = scene.integrator == Integrator::semi_implicit;  // else its solve has no line search
  scene.solver_tolerance = 1e-6;
  scene.step = kStep;
  scene.gravity.setZero();
  return scene;
}

Obstacle plate_at(const Vector3d& center) {
  Obstacle plate = test::box_at(center, {0.5, 0.5, kHalf});
  plate.rim = 0;
  return plate;
}

// Returns the least height of the cloth's vertices over a point that moves along.
double lowest_over(Simulation& simulation, double height) {
  double least = 1e30;
  for (const Vector3d& x : simulation.positions()) least = std::min(least, x.z() - height);
  return least;
}

class Sweep : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Sweep,
                         ::testing::Values("implicit", "bdf2", "tr-bdf2", "quasi-static", "semi-implicit"),
                         test::CaseName());
class SweepInMotion : public Sweep {};  // free cloth, for which there is no equilibrium
INSTANTIATE_TEST_SUITE_P(Integrators, SweepInMotion,
                         ::testing::Values("implicit", "bdf2", "tr-bdf2", "semi-implicit"), test::CaseName());

// Two keys a way L and a time T apart are 1.5 L/T apart in speed in their middle: 5 m/s there, 83 mm a step.
TEST_P(Sweep, PlateOfAMillimetreAtFiveMetresASecondCarriesTheClothBeforeIt) {
  constexpr double kTravel = 0.5, kSeconds = 0.15;
  Scene scene = sheet(GetParam());
  scene.gravity = {0, 0, -9.81};
  // Free cloth has no equilibrium until it lies on the plate.
  const bool statics = scene.integrator == Integrator::quasi_static;
  const double below = statics ? kHalf + 2 * scene.fabric.thickness : kTravel / 2;
  Obstacle plate = plate_at({0, 0, -below});
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, kTravel}, 0}};
  scene.obstacle = {plate};
  const Trial trial(scene);
  const auto simulation = trial.at(kSeconds);
  EXPECT_GT(lowest_over(*simulation, kTravel - below + kHalf), 0);
  EXPECT_EQ(simulation->counts().deep, 0);
  EXPECT_LT(simulation->ledger().remainder_relative, kSweptClosed);
  EXPECT_GT(simulation->ledger().obstacle_work, 0);
}

// From 1.3 m, 5.05 m/s; 84 mm a step are 84 thicknesses of the plate.
TEST_P(Sweep, ClothThatFallsAtFiveMetresASecondStaysOnAPlateOfAMillimetre) {
  constexpr double kFall = 1.3;
  Scene scene = sheet(GetParam());
  scene.gravity = {0, 0, -9.81};
  const bool statics = scene.integrator == Integrator::quasi_static;  // there cloth would fall without end
  scene.obstacle = {plate_at({0, 0, statics ? -2 * Fabric{}.thickness : -kFall})};
  const Trial trial(scene);
  const auto simulation = trial.after(statics ? 3 : 40);
  EXPECT_GT(lowest_over(*simulation, scene.obstacle[0].center.z() + kHalf), 0);
  EXPECT_EQ(simulation->counts().deep, 0);
  EXPECT_LT(simulation->ledger().remainder_relative, kSweptClosed);
}

// The blade of a fan: 15 degrees a step at its fastest, and cloth that is 20 cm from the axis.
TEST_P(SweepInMotion, TurningPlateTakesTheClothAlong) {
  constexpr double kDegrees = 90, kSeconds = 0.15, kArm = 0.2;
  Scene scene = sheet(GetParam());
  scene.cloth.position.x() += kArm;
  Obstacle plate = plate_at({0, 0, -0.02});
  plate.motion.axis = {0, 1, 0};
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, 0}, -kDegrees}};
  scene.obstacle = {plate};
  const Trial trial(scene);
  const auto simulation = trial.at(kSeconds);
  const Eigen::AngleAxisd back(kDegrees * std::numbers::pi / 180, Vector3d::UnitY());
  for (const Vector3d& x : simulation->positions()) EXPECT_GT((back * x - plate.center).z(), kHalf);
  EXPECT_LT(simulation->ledger().remainder_relative, kSweptClosed);
}

// The plate reaches all three layers in one step, and each may go no farther than the next one: steps in
// parts.
TEST(SweepOfLayers, PlateThatPassesThemInOneStepCarriesAllOfThemApart) {
  constexpr double kTravel = 0.5, kSeconds = 0.15;
  for (const char* integrator : {"implicit", "tr-bdf2"}) {
    Scene scene = sheet(integrator, 150);
    scene.self_contact = true;
    scene.cloth.length = kSweptSide / 2;
    scene.cloth.copies = 3;
    scene.cloth.copy_offset = {0, 0, 5e-3};
    Obstacle plate = plate_at({0, 0, -kTravel / 2});
    plate.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, kTravel}, 0}};
    scene.obstacle = {plate};
    const Trial trial(scene);
    const auto simulation = trial.after(9);
    EXPECT_GT(lowest_over(*simulation, kTravel / 2 + kHalf), 0) << integrator;
    EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty()) << integrator;
    EXPECT_EQ(simulation->counts().deep, 0) << integrator;
    EXPECT_EQ(simulation->counts().unbalanced, 0) << integrator;
    EXPECT_LT(simulation->ledger().remainder_relative, kSweptClosed) << integrator;
  }
}

TEST(SweepInSinglePrecision, CarriesTheClothBeforeAFastPlate) {
  Scene scene = sheet("bdf2");
  scene.precision = Precision::fp32;
  Obstacle plate = plate_at({0, 0, -0.25});
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {0.15, {0, 0, 0.5}, 0}};
  scene.obstacle = {plate};
  EXPECT_GT(lowest_over(*Trial(scene).after(9), 0.25 + kHalf), 0);
}

// Four diameters a step; vertices are 12.5 mm apart.
TEST_P(SweepInMotion, CapsuleOfACentimetreTakesTheVerticesInItsPathAlong) {
  constexpr double kTravel = 0.5, kSeconds = 0.15, kRadius = 0.01;
  Scene scene = sheet(GetParam(), 128);
  scene.mesh = "aligned";  // rows of 9 vertices
  Obstacle capsule;
  capsule.kind = ObstacleKind::capsule;
  capsule.axis = {0, 1, 0};
  capsule.radius = kRadius;
  capsule.height = 0.3;
  capsule.center = {0, 0, -kTravel / 2};
  capsule.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, kTravel}, 0}};
  scene.obstacle = {capsule};
  const Trial trial(scene);
  const auto simulation = trial.after(6);  // one step beyond its fastest one
  const auto set = obstacles_during<double>(scene.obstacle, 0.3, simulation->time(), simulation->time());
  int met = 0;
  for (int i = 0; i < trial.cloth.mesh.vertices(); ++i) {
    if (std::abs(trial.cloth.start[i].x()) > kRadius / 2) continue;
    const Vector3d x = simulation->positions()[i];
    EXPECT_GT(x.z(), set.item[0].center.z());
    EXPECT_GT(distance_to(set.item[0], x).value, 0);
    ++met;
  }
  EXPECT_EQ(met, 9);
  EXPECT_LT(simulation->ledger().remainder_relative, kSweptClosed);
}

// Closes from 12 to 6 cm, past a sheet whose corners are 7 cm from its middle, in four steps.
TEST_P(SweepInMotion, HollowSphereThatClosesKeepsTheClothInside) {
  constexpr double kOpen = 0.12, kSeconds = 4 * kStep;
  Scene scene = sheet(GetParam());
  Obstacle hollow;
  hollow.kind = ObstacleKind::hollow;
  hollow.radius = kOpen;
  hollow.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, 0}, 0}};
  hollow.motion.keys[1].scale = 0.5;
  scene.obstacle = {hollow};
  const Trial trial(scene);
  const auto simulation = trial.after(5);
  for (const Vector3d& x : simulation->positions()) EXPECT_LT(x.norm(), kOpen / 2);
  EXPECT_EQ(simulation->counts().deep, 0);
  EXPECT_LT(simulation->ledger().remainder_relative, kSweptClosed);
}

// Returns the free fraction of a vertex that goes `displacement` from `from`, beside an obstacle.
double free_fraction_of(const Obstacle3<double>& obstacle, const Vector3d& from,
                        const Vector3d& displacement) {
  return free_fraction(Path<double, 1>{{from}, {displacement}}, obstacle);
}

// A point on its way to an obstacle stops half of the way to the middle, where the way meets it at all.
TEST(FreeFraction, EndsHalfwayToTheMiddleOfTheThinnestPart) {
  const auto set = obstacles_during<double>({plate_at({0, 0, 0})}, 0.3, 0, 0);
  const Obstacle3<double>& plate = set.item[0];
  const Vector3d from(0.1, 0, 0.02), through(0, 0, -0.1);
  const double fraction = free_fraction_of(plate, from, through);
  EXPECT_NEAR(from.z() - fraction * 0.1, kHalf / 2, kTouching * kHalf);
  EXPECT_EQ(free_fraction_of(plate, from, Vector3d(0.1, 0.1, 0)), 1);
  EXPECT_EQ(free_fraction_of(plate, from, Vector3d(0, 0, 0.1)), 1);
  EXPECT_EQ(free_fraction_of(plate, Vector3d(0.6, 0, 0.02), through), 1);  // beside it
  // From half the depth a quarter of it is left, and the way out is free.
  const Vector3d inside(0, 0, kHalf / 2);
  EXPECT_NEAR(inside.z() - free_fraction_of(plate, inside, through) * 0.1, kHalf / 4, kTouching * kHalf);
  EXPECT_EQ(free_fraction_of(plate, inside, Vector3d(0, 0, 0.1)), 1);
}

// Every kind that has another side is tried, at rest and in motion: no point of a free path is past the
// middle, and a barred guess ends outside.
TEST(FreeFraction, LeadsNoPathPastTheMiddleOfAnySolid) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-0.03, 0.03);
  const auto point = [&] { return Vector3d(within(random), within(random), within(random)); };
  int blocked = 0;
  for (const ObstacleKind kind : {ObstacleKind::sphere, ObstacleKind::cylinder, ObstacleKind::box,
                                  ObstacleKind::capsule, ObstacleKind::torus}) {
    Obstacle o;
    o.kind = kind;
    o.size = {0.01, 0.01, kHalf};
    o.radius = kind == ObstacleKind::torus ? 0.01 : 2e-3;
    o.height = 4e-3;
    o.rim = 0;
    o.axis = {1, 2, -1};
    o.motion.keys = {{0, {0, 0, 0}, 0}, {1, {0.01, -0.02, 0.01}, 40}};
    const auto set = obstacles_during<double>({o}, 0.3, 0.3, 0.7);
    const Obstacle3<double>& item = set.item[0];
    const VertexPoints<double> vertex{{}, set, nullptr, nullptr};
    for (int k = 0; k < 2000; ++k) {
      const Vector3d start = point(), from = carried<double>(item, start), end = point(),
                     displacement = end - from;
      if (distance_to<double>(item, from).value < 0) continue;
      const double fraction = free_fraction_of(item, from, displacement);
      constexpr int kSamples = 200;
      for (int j = 0; j <= kSamples; ++j)
        ASSERT_GT(distance_to<double>(item, from + fraction * j / kSamples * displacement).value,
                  -0.51 * item.thinnest)
            << enum_name(kind);
      EXPECT_EQ(fraction == 1, path_is_clear<double>(vertex, 0, &start, &end)) << enum_name(kind);
      Vector3d kept = end;
      clip_path<double>(vertex, 0, &start, &kept, 0.0);
      if (fraction == 1) {
        EXPECT_EQ(kept, end) << enum_name(kind);
        continue;
      }
      ++blocked;
      EXPECT_GE(distance_to<double>(item, kept).value, 0) << enum_name(kind);
      EXPECT_TRUE(path_is_clear<double>(vertex, 0, &start, &kept)) << enum_name(kind);
    }
  }
  EXPECT_GT(blocked, 100);
}

// Ground and hollow spheres have no other side; a set of them is not looked at.
TEST(FreeFraction, OfObstaclesWithoutAnotherSideIsNotLookedFor) {
  Obstacle ground, hollow;
  hollow.kind = ObstacleKind::hollow;
  EXPECT_FALSE(obstacles_during<double>({ground, hollow}, 0.3, 0, 0).has_thin());
  EXPECT_FALSE(obstacles_during<float>({}, 0.3, 0, 0).has_thin());
  EXPECT_TRUE(obstacles_during<float>({ground, plate_at({0, 0, 0})}, 0.3, 0, 0).has_thin());
}

// A point that the obstacle carries along stays where it is in its frame, whatever turns, grows or moves.
TEST(Carried, PointsKeepTheirDistanceInUnitsOfTheObstacle) {
  Obstacle plate = plate_at({0.1, 0.2, 0.3});
  plate.motion.axis = {0.6, 0, 0.8};
  plate.motion.center = {0.3, -0.1, 0.2};
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {1, {0.4, 0.5, -0.6}, 50}};
  plate.motion.keys[1].scale = 0.4;
  const auto start = obstacles_during<double>({plate}, 0.3, 0.2, 0.2),
             end = obstacles_during<double>({plate}, 0.3, 0.2, 0.9);
  const double scale = end.item[0].thinnest / start.item[0].thinnest;
  EXPECT_LT(scale, 0.9);
  for (const Vector3d& x : {Vector3d(0.1, 0.5, -0.2), Vector3d(1, 0.2, 0.3), Vector3d(-0.4, 0.1, 0.9)}) {
    const double was = distance_to<double>(start.item[0], x).value,
                 is = distance_to<double>(end.item[0], carried<double>(end.item[0], x)).value;
    EXPECT_NEAR(is, scale * was, 1e-12);
  }
}

}  // namespace
}  // namespace hysteron
