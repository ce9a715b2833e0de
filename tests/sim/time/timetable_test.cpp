// Steps that end when they are asked to, and instants at the ends that are nearest to their times.
#include "sim/time/timetable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/time/scenes.h"

namespace hysteron::test {
namespace {

constexpr double kRoundedTime = 1e-12;  // of sums of some hundred lengths of about 0.01 [s]

std::vector<long> instants(const Timetable& timetable, double rate) {
  std::vector<long> found;
  for (long n = 0; n <= timetable.steps(); ++n)
    if (timetable.is_instant(n, rate)) found.push_back(n);
  return found;
}

TEST(Timetable, OfAWholeNumberOfStepsHasNoShorterOne) {
  for (const double seconds : {0.1, 6.0, 3.4 + 0.6}) {
    const Timetable timetable(seconds, 1.0 / 120);
    EXPECT_EQ(timetable.steps(), std::lround(seconds * 120));
    for (long n = 0; n < timetable.steps(); ++n) ASSERT_TRUE(timetable.is_even(n)) << n;
  }
}

// 0.107 s are ten steps of 0.01 s and one of 0.007 s; 0.104 s nine and two of 0.007 s.
TEST(Timetable, EndsWhenItIsAskedToWithStepsOfMoreThanHalfTheLength) {
  for (const double seconds : {0.107, 0.104}) {
    const Timetable timetable(seconds, 0.01);
    EXPECT_EQ(timetable.steps(), 11);
    EXPECT_NEAR(timetable.time(11), seconds, kRoundedTime);
    EXPECT_NEAR(timetable.between(3, 11), seconds - 0.03, kRoundedTime);
    EXPECT_NEAR(timetable.length(10), 0.007, kRoundedTime);
  }
}

// k/30 in steps of 0.01 s: 0, 3.33, 6.67, 10, 13.3, 16.7, 20.
TEST(Timetable, InstantsAreNearestToTheirTimesWithoutDrift) {
  const Timetable timetable(0.25, 0.01);
  EXPECT_EQ(instants(timetable, 30), (std::vector<long>{0, 3, 7, 10, 13, 17, 20, 23, 25}));
  EXPECT_NEAR(timetable.largest_shift(30), 0.01 / 3, kRoundedTime);
  EXPECT_EQ(timetable.next_instant(7, 30), 10);
  EXPECT_EQ(timetable.largest_shift(25), 0);
}

TEST(Timetable, InstantsOfARateOfZeroAreTheStartAndTheEnd) {
  EXPECT_EQ(instants(Timetable(0.25, 0.01), 0), (std::vector<long>{0, 25}));
}

TEST(Timetable, InstantsOfAHighRateAreAllSteps) {
  EXPECT_EQ(instants(Timetable(0.05, 0.01), 1000), (std::vector<long>{0, 1, 2, 3, 4, 5}));
}

// Steps of 0.1, 0.1, then rests of 0.5 and 20 s.
// The last steps of 0.107 s by 0.01 s end at 0.1 and 0.107 s.
TEST(Timetable, FindsTheFirstStepThatEndsNotBeforeATime) {
  const Timetable timetable(0.107, 0.01);
  EXPECT_EQ(timetable.first_end(0), 0);
  EXPECT_EQ(timetable.first_end(0.03), 3);
  EXPECT_EQ(timetable.first_end(0.1 + 0.2 - 0.27), 3) << "but for rounding";
  EXPECT_EQ(timetable.first_end(0.031), 4);
  EXPECT_EQ(timetable.first_end(0.107), 11);
  EXPECT_EQ(timetable.first_end(0.11), 12) << "there is none";
}

TEST(Timetable, RestsEndInInstantsOfTheirOwn) {
  const Timetable timetable(std::vector{0.1, 0.1, 0.5, 20.0}, 0.1);
  EXPECT_EQ(instants(timetable, 1e-3), (std::vector<long>{0, 3, 4}));
  EXPECT_NEAR(timetable.time(4), 20.7, kRoundedTime);
}

class ShortenedStep : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, ShortenedStep,
                         testing::Values("explicit", "semi-implicit", "implicit", "bdf2", "tr-bdf2"),
                         [](const auto& name) { return case_name(name.param); });

// A sheet that falls freely has the velocity -g t after any steps of any lengths.
TEST_P(ShortenedStep, LetsAFreeFallEndAtItsTime) {
  constexpr double kSolved = 1e-6;  // of the velocity, by the tolerance of the solves
  Scene scene = free_square(8);
  scene.integrator = value_named<Integrator>(GetParam());
  scene.air_drag = 0;
  scene.step = 0.01;
  const Timetable timetable(0.104, scene.step);
  const auto simulation = Trial(scene).simulation();
  advance_along(timetable, *simulation, timetable.steps());
  EXPECT_NEAR(simulation->time(), 0.104, kRoundedTime);
  const double fallen = scene.gravity.z() * 0.104;
  for (const Eigen::Vector3d& v : simulation->velocities()) EXPECT_NEAR(v.z(), fallen, kSolved * -fallen);
}

}  // namespace
}  // namespace hysteron::test
