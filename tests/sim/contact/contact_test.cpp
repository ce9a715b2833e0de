// Cloth on obstacles: it rests, slides by Coulomb's law, is carried along, and falls when they go.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/base/enum_names.h"
#include "sim/contact/compression.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;

constexpr double kGravity = 9.81;

// A cloth of 0.1 m that lies one thickness above the ground, which is tilted by `slope` about y.
Trial on_slope(double slope, double friction) {
  Scene scene = test::free_square(50);
  scene.cloth.length = 0.1;
  scene.law = "prandtl";
  scene.solver_tolerance = 1e-8;
  Obstacle ground;
  ground.axis = {std::sin(slope), 0, std::cos(slope)};
  ground.friction = friction;
  scene.obstacle = {ground};
  scene.cloth.rotation = {0, slope * 180 / std::numbers::pi, 0};
  scene.cloth.position = scene.fabric.thickness * ground.axis;
  return Trial(scene);
}

// Returns the mean displacement down the slope [m].
double slid(const Trial& trial, Simulation& simulation, double slope) {
  const Vector3d down(std::cos(slope), 0, -std::sin(slope));
  const auto x = simulation.positions();
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += down.dot(x[i] - trial.cloth.start[i]);
  return sum / static_cast<double>(x.size());
}

// Below the friction angle, tan a < mu, a stop holds for good; a velocity-smoothed friction would creep.
TEST(Contact, HoldsAClothOnASlopeBelowTheFrictionAngleWithoutCreep) {
  constexpr double kFriction = 0.3, kSlope = 0.25;  // tan 0.25 = 0.255
  const Trial trial = on_slope(kSlope, kFriction);
  // The stop slips elastically until it bears the weight's pull, at the friction angle by 1 % of the
  // thickness.  Before the normal force is there it slips a little more.
  const double elastic = 0.01 * trial.scene.fabric.thickness * std::tan(kSlope) / kFriction;
  constexpr double kLanding = 2;
  constexpr double kCreep = 1e-10;  // [m] in 0.7 s
  const auto simulation = trial.after(300);
  const double early = slid(trial, *simulation, kSlope);
  EXPECT_GT(early, 0.9 * elastic);
  EXPECT_LT(early, kLanding * elastic);
  simulation->advance(700);
  EXPECT_NEAR(slid(trial, *simulation, kSlope), early, kCreep);
}

TEST(Contact, LiesFlatOnTheGroundAtTheDepthThatBearsItsWeight) {
  const Trial trial = on_slope(0, 0.3);
  const double t = trial.scene.fabric.thickness,
               sink =
                   t - distance_under(obstacle_response(trial.scene), trial.scene.fabric.density * kGravity);
  for (const Vector3d& x : trial.after(300)->positions()) EXPECT_NEAR(t - x.z(), sink, 0.01 * sink);
}

// The acceleration is a = g (sin slope - mu cos slope) beyond the friction angle.
TEST(Contact, LetsAClothSlideByCoulombsLawAboveTheFrictionAngle) {
  constexpr double kFriction = 0.3;
  constexpr double kOneStep =
      0.02;  // friction follows the load of the same step; the first ones build the stop up
  for (const double slope : {0.4, 0.6, 0.9}) {
    const Trial trial = on_slope(slope, kFriction);
    const auto simulation = trial.after(100);
    const Vector3d down(std::cos(slope), 0, -std::sin(slope));
    const auto mean_speed = [&] {
      const auto v = simulation->velocities();
      double sum = 0;
      for (const Vector3d& vi : v) sum += down.dot(vi);
      return sum / static_cast<double>(v.size());
    };
    const double early = mean_speed(), start = simulation->time();
    simulation->advance(100);
    const double acceleration = (mean_speed() - early) / (simulation->time() - start);
    EXPECT_NEAR(acceleration / (kGravity * (std::sin(slope) - kFriction * std::cos(slope))), 1, kOneStep)
        << slope;
  }
}

TEST(Contact, WithoutFrictionSlidesAsOnIce) {
  constexpr double kSlope = 0.4;
  constexpr double kOneStep = 0.01;
  const Trial trial = on_slope(kSlope, 0);
  const auto simulation = trial.after(200);
  const double t = simulation->time();
  EXPECT_NEAR(slid(trial, *simulation, kSlope) / (kGravity * std::sin(kSlope) * t * t / 2), 1, kOneStep);
  EXPECT_EQ(simulation->ledger().contact_friction, 0);
}

TEST(Contact, HeatOfSlidingIsFrictionTimesWay) {
  constexpr double kSlope = 0.6, kFriction = 0.3;
  constexpr double kOneStep = 0.03;  // the first steps build the stop up
  const Trial trial = on_slope(kSlope, kFriction);
  const auto simulation = trial.after(200);
  const double weight = trial.scene.fabric.density * 0.01 * kGravity;  // [N]
  const double heat = kFriction * weight * std::cos(kSlope) * slid(trial, *simulation, kSlope);
  EXPECT_NEAR(simulation->ledger().contact_friction / heat, 1, kOneStep);
}

// The table drives off gently (its greatest acceleration, 6 s/T^2 = 1.5 m/s^2, stays below mu g) and stops.
TEST(Contact, MovingTableCarriesItsCloth) {
  constexpr double kTravel = 0.04, kSeconds = 0.4;
  constexpr double kSlip = 1e-5;  // [m]: the stop's elastic slip is up to 5e-6 m
  Trial trial = on_slope(0, 0.3);
  Obstacle& table = trial.scene.obstacle[0];
  table.kind = ObstacleKind::box;
  table.size = {0.2, 0.2, 0.05};
  table.center = {0.05, 0.05, -0.05};
  table.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {kTravel, 0, 0}, 0}};
  const auto simulation = trial.after(600);
  EXPECT_NEAR(slid(trial, *simulation, 0), kTravel, kSlip);
  EXPECT_LT(simulation->ledger().remainder_relative, 1e-9);
}

TEST(Contact, TurningTableCarriesItsClothAround) {
  constexpr double kDegrees = 30, kSeconds = 1;
  constexpr double kSlip = 1e-4;  // [m]: at the corners
  Trial trial = on_slope(0, 0.6);
  Obstacle& table = trial.scene.obstacle[0];
  table.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, 0}, kDegrees}};
  table.motion.center = {0.05, 0.05, 0};
  const Eigen::AngleAxisd turn(kDegrees * std::numbers::pi / 180, Vector3d::UnitZ());
  test::Positions expected;
  for (const Vector3d& x : trial.cloth.start)
    expected.push_back(turn * (x - table.motion.center) + table.motion.center);
  EXPECT_LT(test::farthest(trial.after(1200)->positions(), expected), kSlip);
}

TEST(Contact, TableTakenAwayLetsItsClothFall) {
  Trial trial = on_slope(0, 0.3);
  trial.scene.obstacle[0].until = 0.1;
  const auto simulation = trial.after(100);
  const double resting = simulation->positions()[0].z();
  EXPECT_NEAR(resting, distance_under(obstacle_response(trial.scene), trial.scene.fabric.density * kGravity),
              1e-8);
  simulation->advance(100);
  const double fall = kGravity * 0.1 * 0.1 / 2;
  EXPECT_NEAR((resting - simulation->positions()[0].z()) / fall, 1, 0.02);
}

// Cloth over every kind of obstacle: no vertex is ever in it.
TEST(Contact, NothingFallsThroughAnyObstacle) {
  for (const ObstacleKind kind : {ObstacleKind::ground, ObstacleKind::sphere, ObstacleKind::cylinder,
                                  ObstacleKind::box, ObstacleKind::capsule, ObstacleKind::torus}) {
    Scene scene = test::free_square(300);
    scene.law = "prandtl";
    scene.solver_tolerance = 1e-4;
    scene.cloth.position = {-0.1, -0.1, 0.01};
    Obstacle o;
    o.kind = kind;
    o.radius = 0.06;
    o.height = 0.1;
    o.size = {0.05, 0.05, 0.05};
    o.rim = 0.005;
    const std::string name = enum_name(kind);
    o.center.z() = name == "ground" ? 0 : name == "sphere" ? -0.06 : name == "capsule" ? -0.11 : -0.05;
    scene.obstacle = {o};
    const Trial trial(scene);
    const auto simulation = trial.after(150);
    double top = -1;
    for (const Vector3d& x : simulation->positions()) top = std::max(top, x.z());
    EXPECT_GT(top, 0) << name;                         // held up
    EXPECT_LT(top, scene.cloth.position.z()) << name;  // it did fall onto it
    EXPECT_GT(simulation->ledger().contact, 0) << name;
    EXPECT_EQ(simulation->counts().deep, 0) << name;
  }
}

}  // namespace
}  // namespace hysteron
