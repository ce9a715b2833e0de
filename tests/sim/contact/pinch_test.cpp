// Cloth between solids that close on it: pressed, pinched and let go.
#include <gtest/gtest.h>

#include "sim/mesh/intersections.h"
#include "sim/scene/body.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/mesh_bodies.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::kAccepted;
using test::says;
using test::Trial;

constexpr double kDown = 0.1;   // time in which the plate comes down [s]
constexpr int kCannotGoOn = 3;  // exit code

// Adds a plate of 2 cm over the ground whose underside comes down from 1 cm to `lowest` [m].
void add_press(Scene& scene, double lowest) {
  Obstacle plate = test::box_at({0.05, 0.05, 0.02}, {0.2, 0.2, 0.01});
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {kDown, {0, 0, lowest - 0.01}, 0}};
  scene.obstacle = {Obstacle{}, plate};
}

// Returns a sheet on the ground under the plate.
Trial pressed_sheet(const std::string& integrator, double lowest) {
  Scene scene = test::free_square(60);
  scene.cloth.length = 0.1;
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.step = integrator == "implicit" ? 1.0 / 240 : 1e-3;
  scene.solver_tolerance = 1e-6;
  scene.cloth.position = {0, 0, scene.fabric.thickness};
  add_press(scene, lowest);
  return Trial(scene);
}

// Moves on until the plate is down; what ends the run.
std::string press(const Trial& trial, Simulation& simulation) {
  return test::refusal([&] { simulation.advance(trial.steps(1.2 * kDown)); }, kCannotGoOn);
}

// The plate goes up again as far as it came down, in the same time.
void lift_press(Scene& scene) { scene.obstacle[1].motion.keys.push_back({2.2 * kDown, {0, 0, 0.03}, 0}); }

// Between two plates h apart, both barriers give in alike: each is sunk into by t - h/2.  At h = t that is
// half of the activation distance, where they are so stiff that the cloth's weight takes next to nothing.
TEST(Press, DownToTheThicknessLeavesTheSheetInTheMiddle) {
  for (const char* integrator : {"implicit", "semi-implicit"}) {
    const double t = Fabric{}.thickness;
    const Trial trial = pressed_sheet(integrator, t);
    const auto simulation = trial.simulation();
    EXPECT_EQ(press(trial, *simulation), kAccepted) << integrator;
    constexpr double kWeight = 1e-3;  // of the thickness
    for (const Vector3d& x : simulation->positions()) EXPECT_NEAR(x.z(), t / 2, kWeight * t) << integrator;
    EXPECT_EQ(simulation->counts().deep, 0) << integrator;
  }
}

// The plate ends four thicknesses below the ground: the sheet between is in both, and on the ground again
// once the plate has gone up.
TEST(Press, BeyondTheThicknessPinchesTheSheetAndLetsItGo) {
  for (const char* integrator : {"implicit", "semi-implicit", "explicit"}) {
    const double t = Fabric{}.thickness;
    Trial trial = pressed_sheet(integrator, -4 * t);
    lift_press(trial.scene);
    const auto simulation = trial.simulation();
    EXPECT_EQ(press(trial, *simulation), kAccepted) << integrator;
    const Diagnostics down = simulation->counts();
    EXPECT_GT(down.pinched, 0) << integrator;
    EXPECT_GT(down.pinch_depth, 2 * t) << integrator;
    EXPECT_LT(down.pinch_depth, 4.1 * t) << integrator;
    simulation->advance(trial.steps(1.2 * kDown));
    for (const Vector3d& x : simulation->positions()) EXPECT_GT(x.z(), 0) << integrator;
  }
}

// A part of tr-bdf2 has two stages, and the sheet is pinched at the end of either.
TEST(Press, IsCountedOnceAStep) {
  const auto pinched = [](const char* integrator) {
    const Trial trial = pressed_sheet(integrator, -4 * Fabric{}.thickness);
    const auto simulation = trial.simulation();
    EXPECT_EQ(press(trial, *simulation), kAccepted) << integrator;
    return static_cast<double>(simulation->counts().pinched);
  };
  const double once = pinched("bdf2");
  EXPECT_GT(once, 10);
  EXPECT_NEAR(pinched("tr-bdf2") / once, 1, 0.2);
}

// The lower of two layers, folded upon each other, is held; below two thicknesses, less what the barrier
// gives in, the plate has no room.
Trial pressed_layers(double lowest) {
  Trial trial = test::two_sheets(1.1 * Fabric{}.thickness, 100);
  for (Vector3d& x : trial.cloth.start) x.z() += Fabric{}.thickness;
  add_press(trial.scene, lowest);
  trial.scene.pin = {};
  trial.cloth.pin_vertices = {};
  std::fill(trial.cloth.pin.begin(), trial.cloth.pin.end(), -1);
  return trial;
}

TEST(Press, OfTwoLayersHoldsThemApart) {
  const double t = Fabric{}.thickness;
  const Trial trial = pressed_layers(2.5 * t);
  const auto simulation = trial.simulation();
  EXPECT_EQ(press(trial, *simulation), kAccepted);
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty());
}

TEST(Press, OfTwoLayersBeyondTheirThicknessKeepsTheirOrder) {
  const Trial trial = pressed_layers(-3 * Fabric{}.thickness);
  const auto simulation = trial.simulation();
  EXPECT_EQ(press(trial, *simulation), kAccepted);
  EXPECT_GT(simulation->counts().pinched, 0);
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty());
}

// A solid that moves over what a pin holds pinches it, too.
TEST(Press, AgainstAPinIsCounted) {
  Trial trial = pressed_sheet("implicit", -2e-3);
  trial.scene.obstacle[0].center.z() = -1;
  trial.scene.pin = {test::pin_in({-1, -1, -1}, {0.02, 1, 1})};
  trial = Trial(trial.scene);
  const auto simulation = trial.simulation();
  EXPECT_EQ(press(trial, *simulation), kAccepted);
  EXPECT_GT(simulation->counts().pinched, 0);
}

// Returns two solids that meet in the middle of a sheet, from both sides, and part again.
std::vector<Obstacle> two_solids(const std::string& kind, double apart) {
  constexpr double kStart = 0.01, kSize = 0.02;
  const Vector3d middle(0.05, 0.05, 0);
  std::vector<Obstacle> both;
  for (const double side : {-1.0, 1.0}) {
    const Vector3d at = middle + Vector3d(0, 0, side * (kStart / 2 + kSize));
    Obstacle solid = kind == "spheres" ? test::sphere_at(at, kSize) : test::box_at(at, {kSize, kSize, kSize});
    if (kind == "plate and ground" && side < 0) {
      solid = test::ground_at(-kStart / 2);
      both.push_back(solid);
      continue;
    }
    const double way = (kind == "plate and ground" ? 1 : 0.5) * (apart - kStart);
    solid.motion.keys = {{0, {0, 0, 0}, 0}, {kDown, {0, 0, side * way}, 0}, {2 * kDown, {0, 0, 0}, 0}};
    both.push_back(solid);
  }
  return both;
}

// Between corners of boxes without room Newton's method takes hundreds of iterations a step: they come to
// half a thickness.
TEST(Press, BetweenSolidsFromBothSidesEndsWell) {
  const double t = Fabric{}.thickness;
  for (const std::string kind : {"boxes", "spheres", "plate and ground"})
    for (const double share : {1.0, kind == "boxes" ? 2.0 : 0.0}) {
      Scene scene = test::free_square(60);
      scene.cloth.length = 0.1;
      scene.law = "prandtl";
      scene.integrator = Integrator::tr_bdf2;
      scene.step = 1.0 / 240;
      scene.pin = {test::pin_in({-1, -1, -1}, {0.001, 1, 1})};
      scene.obstacle = two_solids(kind, share * t);
      const Trial trial(scene);
      const auto simulation = trial.simulation();
      EXPECT_EQ(test::refusal([&] { simulation->advance(trial.steps(2 * kDown)); }, kCannotGoOn), kAccepted)
          << kind << " " << share;
      EXPECT_EQ(simulation->counts().deep, 0) << kind << " " << share;
      EXPECT_EQ(simulation->counts().pinched > 0, kind == "plate and ground" && share == 0)
          << kind << " " << share;
    }
}

TEST(Press, OfBodiesOfTrianglesPinchesOnlyBelowTheThickness) {
  const double t = Fabric{}.thickness;
  for (const char* integrator : {"implicit", "bdf2", "tr-bdf2"})
    for (const double share : {2.0, 1.0, 0.5, 0.0, -2.0}) {
      const Trial trial = test::between_plates(value_named<Integrator>(integrator), share * t, kDown);
      const auto simulation = trial.simulation();
      ASSERT_EQ(test::refusal([&] { simulation->advance(trial.steps(2 * kDown)); }, kCannotGoOn), kAccepted)
          << integrator << " " << share;
      const Diagnostics down = simulation->counts();
      EXPECT_EQ(down.pinched > 0, share < 0.4) << integrator << " " << share;
      if (down.pinched > 0) {  // what both give in leaves the cloth the distance of the yield
        const double missing = 0.45 - share / 2;
        EXPECT_GT(down.pinch_depth / t, 0.9 * missing) << integrator << " " << share;
        EXPECT_LT(down.pinch_depth / t, 2 * missing) << integrator << " " << share;
      }
      simulation->advance(trial.steps(1.5 * kDown));
      for (const Vector3d& x : simulation->positions()) EXPECT_GT(x.z(), 0) << integrator << " " << share;
    }
}

TEST(Press, OfBodiesOfTrianglesGoesOnFromASavedState) {
  const Trial trial = test::between_plates(Integrator::tr_bdf2, -Fabric{}.thickness, kDown);
  const auto first = trial.after(trial.steps(1.1 * kDown)), second = trial.simulation();
  ASSERT_GT(first->counts().pinched, 0);
  second->load(first->save());
  first->advance(5);
  second->advance(5);
  EXPECT_EQ(second->state_hash(), first->state_hash());
  EXPECT_EQ(second->counts().pinch_depth, first->counts().pinch_depth);
}

// A ball that hits a free sheet drives it in for a moment where its barrier is soft: it is thrown off, not
// pinched.
TEST(Blow, ThatDrivesTheClothDeepIntoAnObstacleIsNoPinch) {
  Scene scene = test::free_square(200);
  scene.integrator = Integrator::implicit;
  scene.step = 1e-4;
  scene.gravity.setZero();
  scene.contact_stiffness = 1e6;
  Obstacle ball = test::sphere_at({0.1, 0.1, -0.05}, 0.03);
  ball.motion.keys = {{0, {0, 0, 0}, 0}, {0.02, {0, 0, 0.1}, 0}};  // 7.5 m/s in its middle
  scene.obstacle = {ball};
  const Trial trial(scene);
  const auto simulation = trial.after(250);
  EXPECT_GT(simulation->counts().deep, 0);
  EXPECT_EQ(simulation->counts().pinched, 0);
  int top = 0;
  for (int i = 1; i < trial.cloth.mesh.vertices(); ++i)
    if ((trial.cloth.start[i] - Vector3d(0.1, 0.1, 0)).norm() <
        (trial.cloth.start[top] - Vector3d(0.1, 0.1, 0)).norm())
      top = i;
  EXPECT_GT((simulation->positions()[top] - Vector3d(0.1, 0.1, 0.05)).norm(), ball.radius);
}

// Newton's first corrections overflow the energy, and so do all shorter ones.
TEST(Equilibrium, ThatIsNotFoundIsReportedWithTheVertexThatIsFarthestFromIt) {
  Scene scene = test::hanging_square(40);
  scene.integrator = Integrator::implicit;
  scene.gravity = {0, 0, -1e140};
  const Trial trial(scene);
  const std::string failure = test::refusal([&] { trial.after(1); }, kCannotGoOn);
  EXPECT_TRUE(says(failure, "no equilibrium of the step at t = 0 s was found, even in parts of ",
                   "an unbalanced force of ", "most of it, ", " N, at vertex ", ") m"));
}

}  // namespace
}  // namespace hysteron
