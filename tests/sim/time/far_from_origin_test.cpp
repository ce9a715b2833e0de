// Cloth behaves alike wherever it is: positions are relative to where it starts.
#include <gtest/gtest.h>

#include "sim/scene/cloth.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;

const Vector3d kFarAway(1e4, -1e4, 1e3);  // [m]

// Returns a flat sheet that a rotating pin lifts by a corner, off a tilted ground and a rotating sphere that
// comes up.
Scene lifted(const Vector3d& place) {
  Scene scene = test::free_square(100);
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 240;
  scene.seconds = 1;
  scene.newton_residual = 1e-10;  // what Newton's method leaves is less than what rounding does
  scene.cloth.position = place;
  Pin moving_pin = test::pin_at(0, 0.2);
  moving_pin.motion.keys = {{0}, {0.2, {0, 0, 0.05}, 20}};
  moving_pin.motion.axis = {0, 1, 0};
  moving_pin.motion.center = place + Vector3d(0.1, 0.2, 0);
  Obstacle ground;
  ground.axis = {0.1, 0, 1};
  const Vector3d normal = ground.axis.normalized();  // any point of the ground stands for it
  ground.center = normal * normal.dot(place + Vector3d(0, 0, -0.025));
  Obstacle ball = test::sphere_at(place + Vector3d(0.15, 0.07, -0.05), 0.04);
  ball.motion.keys = {{0}, {0.1, {0, 0, 0.02}, 40}};
  ball.motion.axis = {1, 0, 0};
  ball.motion.center = ball.center;
  scene.pin = {moving_pin};
  scene.obstacle = {ground, ball};
  return scene;
}

// Returns the difference of the same scene at the origin and far from it, relative to its place.
double difference(Precision precision) {
  test::Positions at[2];
  for (const bool far : {false, true}) {
    const Vector3d place = far ? kFarAway : Vector3d(0, 0, 0);
    Scene scene = lifted(place);
    scene.precision = precision;
    const auto simulation = Trial(scene).after(12);
    EXPECT_GT(simulation->ledger().contact, 0);
    at[far] = simulation->positions();
    for (Vector3d& x : at[far]) x -= place;
  }
  return test::farthest(at[0], at[1]);
}

TEST(FarFromTheOrigin, ClothMovesAsItDoesThere) {
  const double thickness = Fabric{}.thickness;
  // Both are shares of the thickness, of which a double resolves 4e-9 that far away and a float 6e-5 here.
  constexpr double kOfDouble = 2e-8, kOfFloat = 0.1;
  EXPECT_LT(difference(Precision::fp64), kOfDouble * thickness);
  EXPECT_LT(difference(Precision::fp32), kOfFloat * thickness);
}

TEST(FarFromTheOrigin, PositionsAreTheWorlds) {
  for (const Precision precision : {Precision::fp64, Precision::fp32}) {
    Scene scene = lifted(kFarAway);
    scene.precision = precision;
    const Trial trial(scene);
    const auto simulation = trial.simulation();
    constexpr double kRounding = 1e-7;  // of floats a few decimetres from the middle [m]
    EXPECT_LT(test::farthest(simulation->positions(), trial.cloth.start), kRounding);
    EXPECT_EQ(simulation->positions_in_place().fp64, nullptr);
    EXPECT_EQ(simulation->positions_in_place().fp32, nullptr);
  }
}

TEST(FarFromTheOrigin, RefusalsNamePlacesInTheWorld) {
  Scene scene = lifted(kFarAway);
  scene.pin.clear();
  scene.obstacle.resize(1);
  scene.obstacle[0].center.z() += 0.05;
  scene.obstacle[0].from = 0.05;
  EXPECT_TRUE(test::says(test::refusal([&] { Trial(scene).after(24); }, 3),
                         "an obstacle appears where the cloth is: vertex", " at (1e+04, -1e+04, "));
}

TEST(FarFromTheOrigin, FlatClothIsAtRestThough) {
  Scene scene = test::free_square(200);
  scene.self_contact = true;
  scene.integrator = Integrator::implicit;
  scene.gravity.setZero();
  scene.precision = Precision::fp32;
  scene.fabric.thickness =
      0.02;  // beyond its edges: each pair's activation distance comes from their distance at rest
  Trial trial(scene);
  for (Vector3d& x : trial.cloth.mesh.rest) x.x() += 1e6;  // floats are 6 cm apart there
  const auto simulation = trial.after(5);
  constexpr double kRounding = 1e-6;  // [m]
  EXPECT_LT(test::farthest(simulation->positions(), trial.cloth.start), kRounding);
}

// Or runs would not keep their bits.
TEST(LocalOrigin, IsTheWorldsWhereTheClothIsNear) {
  const Trial trial(test::free_square(60));
  EXPECT_TRUE(local_origin(trial.cloth.start).isZero(0));
  const double diagonal = std::sqrt(2.0) * trial.scene.cloth.length;
  for (const double times : {0.9, 1.1}) {
    test::Positions moved = trial.cloth.start;
    for (Vector3d& x : moved) x.z() += times * kLocalBeyond * diagonal;
    EXPECT_EQ(local_origin(moved).isZero(0), times < 1) << times;
  }
}

}  // namespace
}  // namespace hysteron
