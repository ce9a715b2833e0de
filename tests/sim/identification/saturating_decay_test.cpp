// The closed form of a swing under the chapter's friction: against its energy balance, in its limits, and
// from noisy amplitudes.
#include "sim/identification/saturating_decay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hysteron {
namespace {

// A mode is bent by the curvature a [1/m], with b1, b2 [N m], k0 [1/m] and a period of one.
constexpr double kB1 = 7e-6, kB2 = 2e-6, kK0 = 8;
constexpr double kMoment = (kB1 - kB2) * kK0 / 2;

double loss(double a) {
  return a > kK0 ? 4 * kMoment * (a - 2 * kK0 / 3) : 4.0 / 3 * kMoment / (kK0 * kK0) * a * a * a;
}
double stored_slope(double a) { return kB2 * a + (kB1 - kB2) * a * std::max(0.0, 1 - a / kK0); }

SaturatingDecay of_that_mode(double first) { return {first, 4 * kMoment / kB2, kK0, kB1 / kB2}; }

// dE/dA dA/dn = -D by the classical method of fourth order, whose error at this step is below 1e-9.
TEST(SaturatingDecay, IsTheBalanceOfLoopAreasAndStoredEnergy) {
  constexpr double kStep = 1e-3, kRungeKutta = 1e-7;  // at the knee the slope has a kink
  const auto slope = [](double a) { return -loss(a) / stored_slope(a); };
  for (const double first : {40.0, 8.0, 5.0}) {
    double a = first;
    for (int i = 1; i <= 6000; ++i) {
      const double k1 = slope(a), k2 = slope(a + kStep / 2 * k1), k3 = slope(a + kStep / 2 * k2),
                   k4 = slope(a + kStep * k3);
      a += kStep / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      if (i % 100 == 0) {
        EXPECT_NEAR(of_that_mode(first).at(i * kStep), a, kRungeKutta * first) << first << " " << i * kStep;
      }
    }
    EXPECT_LT(a, 0.5 * kK0) << "well below the knee";
  }
}

TEST(SaturatingDecay, TakesTheTimeThatItsAmplitudesSay) {
  constexpr double kRounding = 1e-10;
  for (const double amplitude : {39.0, 20.0, 8.0, 7.9, 1.0, 0.01}) {
    const double time = of_that_mode(40).time_to(amplitude);
    EXPECT_NEAR(of_that_mode(40).at(time) / amplitude, 1, kRounding) << amplitude;
  }
  EXPECT_EQ(of_that_mode(40).time_to(40), 0);
}

// Far above the knee a line, and a parabola of the same stiffness throughout has a hyperbola.
TEST(SaturatingDecay, EndsAsALineAndAsAHyperbola) {
  constexpr double kSmall = 1e-3;  // the knee, and what the term in 1/A leaves of a line
  const SaturatingDecay line{1, 0.5, kSmall * 0.1, 3};
  for (const double t : {0.5, 1.0, 1.5}) EXPECT_NEAR(line.at(t), 1 - 0.5 * t, kSmall);
  constexpr double kKnee = 4, kRate = 24;
  const SaturatingDecay hyperbola{1, kRate, kKnee, 1};
  for (const double t : {0.5, 1.0, 10.0})
    EXPECT_NEAR(hyperbola.at(t), 1 / (1 + kRate / (3 * kKnee * kKnee) * t), 1e-12);
}

// Noise of 1 % of the first amplitude, thirty amplitudes: knees scatter by 4 % and are not biased by more.
TEST(SaturatingDecay, ComesBackFromNoisyAmplitudes) {
  constexpr double kOfExact = 1e-4, kOfNoisy = 0.15;
  const SaturatingDecay true_decay{0.04, 0.09, 0.012, 3};
  std::mt19937 random(3);
  for (const double size : {0.0, 0.01}) {
    std::normal_distribution<double> noise(0, size > 0 ? size * true_decay.first : 1);
    std::vector<double> time, amplitude;
    for (int i = 0; i < 30; ++i) {
      time.push_back(0.13 * i);
      amplitude.push_back(true_decay.at(time[i]) + (size > 0 ? noise(random) : 0));
    }
    const SaturatingDecay found = fit_saturating_decay(time, amplitude);
    const double tolerance = size > 0 ? kOfNoisy : kOfExact;
    EXPECT_NEAR(found.knee / true_decay.knee, 1, tolerance);
    EXPECT_NEAR(found.first / true_decay.first, 1, tolerance);
    EXPECT_NEAR(found.rate / true_decay.rate, 1, tolerance);
  }
}

}  // namespace
}  // namespace hysteron
