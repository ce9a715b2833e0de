// Cloth that is crushed ends the run with place and time; cloth that is only pressed does not.
#include <gtest/gtest.h>

#include "sim/mesh/intersections.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::kAccepted;
using test::says;
using test::Trial;

constexpr double kDown = 0.1;   // time in which the plate comes down [s]
constexpr int kCannotGoOn = 3;  // exit code

// Share of the way of a motion between two keys at a share u of the time between them.
double displacement_done(double u) { return u * u * (3 - 2 * u); }

// A plate of 2 cm over the ground whose underside comes down from 1 cm to `lowest` [m].
void add_press(Scene& scene, double lowest) {
  Obstacle plate = test::box_at({0.05, 0.05, 0.02}, {0.2, 0.2, 0.01});
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {kDown, {0, 0, lowest - 0.01}, 0}};
  scene.obstacle = {Obstacle{}, plate};
}

// A sheet on the ground under the plate.
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

// Between two plates h apart, both shells give in alike: each is sunk into by t - h/2.  At h = t that is half
// of the shell, where it is so stiff that the cloth's weight takes next to nothing.
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

// The middle between ground and plate is in both once the plate is below the ground.
TEST(Press, BeyondTheThicknessEndsTheRunWithObstacleVertexPlaceAndTime) {
  for (const char* integrator : {"implicit", "semi-implicit", "explicit"}) {
    const Trial trial = pressed_sheet(integrator, -4 * Fabric{}.thickness);
    const auto simulation = trial.simulation();
    const std::string failure = press(trial, *simulation);
    EXPECT_TRUE(says(failure, "the cloth is crushed: vertex ", " at (", " mm inside obstacle[",
                     "obstacle[0] (ground)", "obstacle[1] (box)", " and ", "at t = 0."));
    double time = 0;
    EXPECT_EQ(std::sscanf(failure.c_str(), "at t = %lf s", &time), 1);
    const double displacement = 0.01 / (0.01 + 4 * Fabric{}.thickness);
    double u = 0;
    while (displacement_done(u) < displacement) u += 1e-4;
    EXPECT_NEAR(time, u * kDown, 2 * trial.scene.step) << integrator;
    EXPECT_NEAR(simulation->time(), time, 1.01 * trial.scene.step)
        << integrator;  // the state is that before it
  }
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

TEST(Press, OfTwoLayersBeyondTheirThicknessEndsTheRunWithPlaceAndTime) {
  const Trial trial = pressed_layers(-3 * Fabric{}.thickness);
  const auto simulation = trial.simulation();
  EXPECT_TRUE(says(press(trial, *simulation), "the cloth is crushed: vertex ", " mm inside obstacle[",
                   "pressed by", "at t = 0."));
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty());
}

// A solid that moves over what a pin holds crushes it, too.
TEST(Press, AgainstAPinEndsTheRun) {
  Trial trial = pressed_sheet("implicit", -2e-3);
  trial.scene.obstacle[0].center.z() = -1;
  trial.scene.pin = {test::pin_in({-1, -1, -1}, {0.02, 1, 1})};
  trial = Trial(trial.scene);
  EXPECT_TRUE(says(press(trial, *trial.simulation()), "the cloth is crushed: vertex ",
                   "inside obstacle[1] (box)", "held by a pin"));
}

// With a limit on Newton's iterations steps are taken as they are; then it is counted.
TEST(Press, IsCountedWhereStepsAreTakenUnbalanced) {
  Trial trial = pressed_sheet("implicit", -4 * Fabric{}.thickness);
  trial.scene.newton_iterations = 4;
  const auto simulation = trial.simulation();
  EXPECT_EQ(press(trial, *simulation), kAccepted);
  EXPECT_GT(simulation->counts().deep, 3);
}

// A ball that hits a free sheet drives it in for a moment where its shell is soft: it is thrown off, not
// crushed.
TEST(Blow, ThatDrivesTheClothDeepIntoAnObstacleIsNoCrushing) {
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
