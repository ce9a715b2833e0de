// A sheet lies on a slope of ground or of cloth: it slips where tan(slope) = mu, and beyond with Coulomb's
// acceleration g (sin - mu cos).
#include <gtest/gtest.h>

#include <cmath>

#include "sim/contact/compression.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;

constexpr double kSlopeGravity = 9.81, kFriction = 0.3;
constexpr double kBelow = 0.99, kAbove = 1.01;  // tan(slope)/mu

double ramp_angle(double ratio) { return std::atan(ratio * kFriction); }

// How far those vertices have come in x, in the mean [m].
double mean_displacement(const Trial& trial, Simulation& simulation, const std::vector<int>& vertices) {
  const auto x = simulation.positions();
  double sum = 0;
  for (int i : vertices) sum += x[i].x() - trial.cloth.start[i].x();
  return sum / static_cast<double>(vertices.size());
}

double average_speed(Simulation& simulation, const std::vector<int>& vertices) {
  const auto v = simulation.velocities();
  double sum = 0;
  for (int i : vertices) sum += v[i].x();
  return sum / static_cast<double>(vertices.size());
}

// Gravity is tilted instead of the ground: down the slope is x.
void tilt(Scene& scene, double slope) {
  scene.gravity = kSlopeGravity * Vector3d(std::sin(slope), 0, -std::cos(slope));
  scene.fabric.friction = kFriction;
}

// Returns a sheet of 10 cm on the ground, which has sunk in by its weight: by 1e-4 of the thickness for all
// of g.
Trial on_ground(double slope, const std::string& integrator) {
  Scene scene = test::free_square(60);
  scene.cloth.length = 0.1;
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.step = 1.0 / 240;
  tilt(scene, slope);
  scene.cloth.position = {0, 0, (1 - 1e-4 * std::cos(slope)) * scene.fabric.thickness};
  scene.obstacle = {Obstacle{}};
  return Trial(scene);
}

// A sheet of 5 cm on a larger one that is held, just touching it.
Trial on_cloth(double slope) {
  Trial trial = test::two_sheets(0.999 * Fabric{}.thickness, 60);
  tilt(trial.scene, slope);
  return trial;
}

struct Slide {
  double creep;         // way in the second half of the time [m]
  double acceleration;  // over the second half [m/s^2]
};

Slide slide(const Trial& trial, double seconds) {
  std::vector<int> vertices = test::upper_vertices(trial);
  const int half = trial.steps(seconds / 2);
  const auto simulation = trial.after(half);
  const double displacement = mean_displacement(trial, *simulation, vertices),
               speed = average_speed(*simulation, vertices);
  simulation->advance(half);
  return {mean_displacement(trial, *simulation, vertices) - displacement,
          (average_speed(*simulation, vertices) - speed) / (half * trial.scene.step)};
}

double coulomb(double slope) { return kSlopeGravity * (std::sin(slope) - kFriction * std::cos(slope)); }

constexpr double kHeld = 1e-10;  // [m] in half a second: what rounding and Newton's tolerance leave

class SlopeOfGround : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, SlopeOfGround, testing::Values("implicit", "bdf2", "tr-bdf2"));

TEST_P(SlopeOfGround, HoldsASheetForGoodOnePercentBelowTheTangentOfFriction) {
  const Slide found = slide(on_ground(ramp_angle(kBelow), GetParam()), 1);
  EXPECT_LT(std::abs(found.creep), kHeld);
}

TEST_P(SlopeOfGround, LetsItSlideByCoulombsLawOnePercentAbove) {
  constexpr double kNewton = 1e-3;  // of the acceleration: what Newton's tolerance leaves
  const double slope = ramp_angle(kAbove);
  EXPECT_GT(coulomb(slope), 0);
  EXPECT_NEAR(slide(on_ground(slope, GetParam()), 1).acceleration / coulomb(slope), 1, kNewton);
}

TEST(SlopeOfCloth, HoldsASheetForGoodOnePercentBelowTheTangentOfFriction) {
  EXPECT_LT(std::abs(slide(on_cloth(ramp_angle(kBelow)), 0.5).creep), kHeld);
}

TEST(SlopeOfCloth, HoldsASheetForAMinute) {
  Trial trial = on_cloth(ramp_angle(kBelow));
  trial.scene.step = 1.0 / 60;
  const Slide found = slide(trial, 60);
  EXPECT_LT(std::abs(found.creep), kHeld);
}

// A plate without friction comes down on it, squeezes it by a third of the thickness and lifts, twenty times:
// the pairs that bear change, and the sheet must not walk.  Once, it comes down by less than the elastic
// slip.
TEST(SlopeOfCloth, KeepsASheetThatIsPressedAgainAndAgain) {
  Trial trial = on_cloth(ramp_angle(0.5));
  trial.scene.step = 1.0 / 120;
  const double thickness = Fabric{}.thickness;
  Obstacle plate = test::box_at({0.035, 0.035, 0.01}, {0.2, 0.2, 0.01});
  plate.friction = 0;
  for (int k = 0; k <= 40; ++k)
    plate.motion.keys.push_back({0.1 * k + 0.1, {0, 0, (k % 2 ? 1.7 : 2.1) * thickness}, 0});
  trial.scene.obstacle = {plate};
  const std::vector<int> vertices = test::upper_vertices(trial);
  const auto simulation = trial.after(36);
  const double once = mean_displacement(trial, *simulation, vertices);
  simulation->advance(19 * 24);
  const double often = mean_displacement(trial, *simulation, vertices);
  constexpr double kWalk = 1e-3;  // of the elastic slip
  EXPECT_GT(once, 0);
  EXPECT_LT(once, kElasticSlip * thickness);
  EXPECT_LT(std::abs(often - once), kWalk * kElasticSlip * thickness);
}

// The layers' meshes do not match: while it slides, the pairs that bear the sheet change, and with them, a
// little, the pressure.
TEST(SlopeOfCloth, LetsItSlideByCoulombsLawOnePercentAbove) {
  constexpr double kPairs = 0.02;
  const double slope = ramp_angle(kAbove);
  EXPECT_NEAR(slide(on_cloth(slope), 0.5).acceleration / coulomb(slope), 1, kPairs);
}

}  // namespace
}  // namespace hysteron
