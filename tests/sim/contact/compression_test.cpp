// These tests press on obstacles and measure their response.
#include "sim/contact/compression.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

constexpr double kTest = 50 * 98.0665;  // pressure of the KES compression test, 50 gf/cm^2 [Pa]

TEST(ObstacleResponse, GivesInByAFifthUnderThePressureOfTheCompressionTest) {
  Scene scene;
  const double t = scene.fabric.thickness;
  EXPECT_NEAR(distance_under(obstacle_response(scene), kTest) / t, 0.8, 1e-9);
}

TEST(ObstacleResponse, HasTheStiffnessOfTheSceneThereAndUntilItIsCrushed) {
  Scene scene;
  scene.integrator = Integrator::implicit;
  scene.contact_stiffness = 1e7;
  const ObstacleResponse<double> response = obstacle_response(scene);
  const double t = scene.fabric.thickness;
  for (double fraction : {0.8, 0.5, 0.4}) EXPECT_NEAR(response.at(fraction * t).stiffness / 1e7, 1, 1e-12);
  EXPECT_LT(response.at(0.9 * t).stiffness, 0.5e7);
  EXPECT_GT(response.at(0.1 * t).stiffness, 5e7);
}

// A blow must not end in a stiffness that steps without equilibrium do not bear.
TEST(ObstacleResponse, KeepsItsStiffnessBeyondThatWhereStepsFindNoEquilibrium) {
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit}) {
    Scene scene;
    scene.contact_stiffness = 1e7;
    scene.integrator = integrator;
    const ObstacleResponse<double> response = obstacle_response(scene);
    for (double fraction : {0.8, 0.4, 0.0, -3.0})
      EXPECT_NEAR(response.at(fraction * scene.fabric.thickness).stiffness / 1e7, 1, 1e-12);
  }
}

// A hundred times the test's pressure do not bring cloth to a solid's surface.
TEST(ObstacleResponse, KeepsClothOutOfTheSolidUnderAHundredTimesThatPressure) {
  Scene scene;
  scene.integrator = Integrator::implicit;
  EXPECT_GT(distance_under(obstacle_response(scene), 100 * kTest), 0);
}

// Deeper in the solid it is as stiff as at the compression of the test.
TEST(ObstacleResponse, YieldsNextToTheSurface) {
  Scene scene;
  scene.integrator = Integrator::implicit;
  const ObstacleResponse<double> response = obstacle_response(scene);
  EXPECT_GT(response.yield, 0);
  EXPECT_LT(response.yield, 0.01 * response.thickness);
  EXPECT_NEAR(-response.at(response.yield).slope / kYieldPressure, 1, 1e-6);
  for (double depth : {0.0, 1e-3, 1.0}) {
    EXPECT_EQ(response.at(-depth).stiffness, response.stiffest());
    const double pressure = kYieldPressure + response.stiffest() * (response.yield + depth);
    EXPECT_NEAR(-response.at(-depth).slope / pressure, 1, 1e-6);
    EXPECT_NEAR(distance_under(response, pressure), -depth, 1e-9);
  }
}

// Pressure is the slope of the energy, stiffness that of the pressure, across the end of what was measured.
TEST(ObstacleResponse, HasSmoothEnergyPressureAndStiffness) {
  Scene scene;
  scene.integrator = Integrator::implicit;
  const ObstacleResponse<double> response = obstacle_response(scene);
  const double t = response.thickness, h = 1e-5 * t;
  for (double fraction : {0.999, 0.95, 0.85, 0.8001, 0.7999, 0.6, 0.399, 0.1, 0.0041, 0.0039, -0.5}) {
    const double d = fraction * t;
    const auto low = response.at(d - h), high = response.at(d + h), middle = response.at(d);
    EXPECT_NEAR((high.energy - low.energy) / (2 * h) / middle.slope, 1, 1e-4) << fraction;
    EXPECT_NEAR((high.slope - low.slope) / (2 * h) / middle.stiffness, 1, 1e-3) << fraction;
  }
}

TEST(ObstacleResponse, PressesFromItsThicknessOn) {
  const ObstacleResponse<double> response = obstacle_response(Scene{});
  EXPECT_NEAR(response.at(response.thickness).slope, 0, 1e-12);
  EXPECT_NEAR(distance_under(response, 0), response.thickness, 1e-9 * response.thickness);
}

}  // namespace
}  // namespace hysteron
