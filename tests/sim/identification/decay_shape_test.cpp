// These tests check how a swing's amplitude falls: turning points of known series, names of the closed laws
// of decay.
#include "sim/identification/decay_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/identification/saturating_decay.h"

namespace hysteron {
namespace {

constexpr double kAny = 1e9;  // amplitudes that are all small
constexpr double kPi = 3.14159265358979323846;

std::vector<Amplitude> amplitude_series(const std::vector<double>& values) {
  std::vector<Amplitude> all;
  for (std::size_t i = 0; i < values.size(); ++i) all.push_back({static_cast<int>(i), 0.1 * i, values[i]});
  return all;
}

constexpr int kTurns = 16;

// Returns the amplitudes of those half periods, from 60 mm.
template <class Law>
std::vector<Amplitude> decaying(const Law& law) {
  std::vector<double> values;
  for (int n = 0; n < kTurns; ++n) values.push_back(0.06 * law(n));
  return amplitude_series(values);
}

TEST(TurningPoints, OfASineAreItsExtremesBetweenTheSamples) {
  std::vector<double> time, x;
  const double rate = 2 * kPi * 1.7, step = 1.0 / 60, phase = 0.3;
  for (int i = 0; i < 120; ++i)
    time.push_back(i * step), x.push_back(3 + 0.02 * std::sin(rate * i * step + phase));
  const auto turns = turning_points(time, x, 1e-3);
  ASSERT_EQ(turns.size(), 7u) << "6.8 half periods after a tenth of one";
  // With samples h apart the parabola misses a sine's vertex by some (w h)^4/400 of the amplitude, in time by
  // some (w h)^2/50 of h; w h = 0.18.
  for (std::size_t k = 0; k < turns.size(); ++k) {
    EXPECT_NEAR(turns[k].time, ((0.5 + k) * kPi - phase) / rate, 1e-2 * step);
    EXPECT_NEAR(turns[k].value, 3 + (k % 2 ? -0.02 : 0.02), 1e-3 * 0.02);
  }
}

// x = 2 - (t - 0.12)^2 is sampled at 0, 0.1 and 0.13 s, and is a parabola itself.
TEST(TurningPoints, OfUnequalSamplesAreThoseOfTheParabolaThroughThem) {
  constexpr double kRounding = 1e-12;
  const auto x = [](double t) { return 2 - std::pow(t - 0.12, 2); };
  const Eigen::Vector2d vertex = vertex_of_parabola(0.1, 0.03, {x(0), x(0.1), x(0.13)});
  EXPECT_NEAR(vertex.x(), 0.02, kRounding);
  EXPECT_NEAR(vertex.y(), 2, kRounding);
}

TEST(TurningPoints, PassOverWavesSmallerThanTheLeast) {
  std::vector<double> time, x;
  for (int i = 0; i < 400; ++i) {
    time.push_back(0.01 * i);
    x.push_back(std::cos(2 * kPi * 0.01 * i) - 0.02 * std::sin(40 * kPi * 0.01 * i));
  }
  EXPECT_EQ(turning_points(time, x, 0.1).size(), 7u);
  EXPECT_GT(turning_points(time, x, 1e-3).size(), 20u);
}

// A step back by half of the way so far makes turns of its own, one by a fifth none.
TEST(TurningPoints, PassOverRipplesOnLargerSwings) {
  for (const double ripple : {1.0 / 3, 1.0 / 9}) {
    std::vector<double> time, x;
    for (int n = 0; n <= 8; ++n)  // to and fro between -1 and 1, with a step back on the way
      for (const double at : {n % 2 ? 1.0 : -1.0, n % 2 ? -ripple : ripple, n % 2 ? ripple : -ripple})
        time.push_back(static_cast<double>(time.size())), x.push_back(at);
    EXPECT_EQ(turning_points(time, x, 0.01, 0.25).size(), ripple > 0.25 ? 25u : 8u) << ripple;
  }
}

// A drift of the middle, as of cloth that settles, is no amplitude.
TEST(Amplitudes, AreDistancesToTheNeighboursMean) {
  std::vector<TurningPoint> turns;
  for (int n = 0; n < 8; ++n) turns.push_back({0.1 * n, 0.5 + 0.03 * n + (n % 2 ? -0.2 : 0.2)});
  const auto all = turning_amplitudes(turns);
  ASSERT_EQ(all.size(), 6u);
  for (const Amplitude& a : all) EXPECT_NEAR(a.value, 0.2, 1e-15) << a.turn;
  EXPECT_EQ(all.front().turn, 1);
}

struct Closed {
  const char* name;
  DecayShape shape;
  double (*law)(int);
};
const Closed kClosed[] = {
    {"linear", DecayShape::linear, [](int n) { return 1 - 0.055 * n; }},
    {"two-step", DecayShape::two_step, [](int n) { return n < 8 ? 1 - 0.1 * n : 0.2 - 0.008 * (n - 8); }},
    {"exponential", DecayShape::exponential, [](int n) { return std::exp(-0.1 * n); }},
    {"hyperbolic", DecayShape::hyperbolic, [](int n) { return 1 / (1 + 0.2 * n); }},
    {"saturating", DecayShape::saturating,
     [](int n) {
       return SaturatingDecay{1, 0.4, 0.3, 3}.at(n);
     }},
};

TEST(DecayShape, OfEveryClosedLawIsItsOwn) {
  for (const Closed& closed : kClosed) {
    const Decay decay = decay_between_amplitudes(decaying(closed.law), kAny);
    EXPECT_EQ(enum_name(decay.shape), closed.name);
    EXPECT_EQ(decay.shape, closed.shape);
    ASSERT_EQ(decay.fits.size(), 5u);
    EXPECT_GT(decay.margin, 20) << closed.name;
    EXPECT_NEAR(decay.per_turn, 1 - std::pow(closed.law(kTurns - 1), 1.0 / (kTurns - 1)), 1e-12);
    for (int n = 0; n < kTurns; ++n)  // the beginning of a second line is found to 1/400 of the time
      EXPECT_NEAR(decay.best().at(0.1 * n), 0.06 * closed.law(n), 1e-3 * 0.06) << closed.name << " " << n;
  }
}

TEST(DecayShape, OfTwoLinesSaysWhereTheSecondBegins) {
  const Decay decay = decay_between_amplitudes(decaying(kClosed[1].law), kAny);
  EXPECT_NEAR(decay.step_fraction(), 0.2, 2e-3);
  EXPECT_NEAR(decay.best().rate, 0.1 * 0.06 / 0.1, 1e-3 * 0.06);
  EXPECT_NEAR(decay.best().last_rate, 0.008 * 0.06 / 0.1, 1e-3 * 0.06);
}

TEST(DecayShape, ThatSaturatesSaysWhereItsKneeIs) {
  const Decay decay = decay_between_amplitudes(decaying(kClosed[4].law), kAny);
  EXPECT_NEAR(decay.knee_fraction(), 0.3, 1e-3);
  EXPECT_NEAR(decay.best().rate, 0.4 * 0.06 / 0.1, 1e-2 * 0.24);
}

// With its knee far below all amplitudes the saturating shape is a line, with its knee above them and one
// stiffness a hyperbola.
TEST(DecayShape, ThatSaturatesGivesWayToItsLimits) {
  const auto named = [](const SaturatingDecay& law) {
    std::vector<double> values;
    for (int n = 0; n < kTurns; ++n) values.push_back(law.at(n));
    return decay_between_amplitudes(amplitude_series(values), kAny).shape;
  };
  EXPECT_EQ(named({1, 0.055, 1e-4, 3}), DecayShape::linear);
  EXPECT_EQ(named({1, 9.6, 4, 1}), DecayShape::hyperbolic);
}

// a = 2^-n loses a half in each half period; a line of steps of 0.1 loses 0.1/A at its amplitudes.
TEST(HalfPeriodLoss, IsReadBetweenTheAmplitudesAround) {
  constexpr double kRounding = 1e-12, kInterpolated = 0.02;
  std::vector<double> halves, line;
  for (int n = 0; n < 6; ++n) halves.push_back(std::pow(2.0, -n)), line.push_back(1 - 0.1 * n);
  EXPECT_NEAR(half_period_loss(amplitude_series(halves), 0, 0.3), 0.5, kRounding);
  EXPECT_NEAR(half_period_loss(amplitude_series(halves), 1, 0.3), 0.5, kRounding);
  EXPECT_NEAR(half_period_loss(amplitude_series(line), 0, 0.7), 0.1 / 0.75, kInterpolated);
  EXPECT_NEAR(half_period_loss(amplitude_series(line), 0, 0.65), 0.1 / 0.7, kRounding);
  EXPECT_TRUE(std::isnan(half_period_loss(amplitude_series(line), 0, 0.1))) << "never so small";
  EXPECT_TRUE(std::isnan(half_period_loss(amplitude_series({1, 0.2, 0.1}), 0, 0.7))) << "nothing before";
  EXPECT_TRUE(std::isnan(half_period_loss({}, 0, 0.5)));
}

// The noise is 1 % of the first amplitude, the same for all.
TEST(DecayShape, IsNamedRightIn19Of20NoisySeries) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.01 * 0.06);
  for (const Closed& closed : kClosed) {
    int right = 0, other = 0;
    for (int draw = 0; draw < 20; ++draw) {
      auto all = decaying(closed.law);
      for (Amplitude& a : all) a.value += noise(random);
      const DecayShape shape = decay_between_amplitudes(all, kAny).shape;
      right += shape == closed.shape;
      other += shape != closed.shape && shape != DecayShape::unknown;
    }
    EXPECT_GE(right, 19) << closed.name << ", " << other << " as another";
  }
}

TEST(DecayShape, IsNotNamedWhereAmplitudesAreFewOrHardlyFall) {
  const auto law = [](int n) { return 1 / (1 + 0.2 * n); };
  EXPECT_EQ(decay_between_amplitudes({}, kAny).shape, DecayShape::unknown);
  EXPECT_EQ(decay_between_amplitudes(amplitude_series({1, law(1), law(2), law(3), law(4)}), kAny).shape,
            DecayShape::unknown);
  EXPECT_TRUE(
      decay_between_amplitudes(amplitude_series({1, law(1), law(2), law(3), law(4)}), kAny).fits.empty());
  EXPECT_EQ(
      decay_between_amplitudes(amplitude_series({1, law(1), law(2), law(3), law(4), law(5)}), kAny).shape,
      DecayShape::hyperbolic);
  EXPECT_EQ(decay_between_amplitudes(amplitude_series({1, 0.97, 0.94, 0.91, 0.88, 0.85}), kAny).shape,
            DecayShape::unknown)
      << "15 %";
  EXPECT_EQ(decay_between_amplitudes(amplitude_series({1, 0.92, 0.95, 0.83, 0.86, 0.8, 0.81}), kAny).shape,
            DecayShape::unknown);
}

TEST(DecayShape, IsAPlateauWhereATurnTakesNothing) {
  const Decay decay =
      decay_between_amplitudes(decaying([](int n) { return 0.3 + 0.7 * (n == 0) - 0.001 * n; }), kAny);
  EXPECT_EQ(decay.first, 1u) << "the first turn took two thirds";
  EXPECT_EQ(decay.shape, DecayShape::plateau);
  EXPECT_TRUE(decay.fits.empty());
  EXPECT_GT(decay.per_turn, 0);
}

TEST(DecayShape, IsThatOfSmallSwings) {
  std::vector<double> values = {1, 0.9, 0.82};  // as by another law
  for (int n = 0; n < 10; ++n) values.push_back(0.8 * std::exp(-0.1 * n));
  const Decay decay = decay_between_amplitudes(amplitude_series(values), 0.81);
  EXPECT_EQ(decay.first, 3u);
  EXPECT_EQ(decay.shape, DecayShape::exponential);
  EXPECT_EQ(decay_between_amplitudes(amplitude_series(values), 0.4).shape, DecayShape::unknown);
}

// Two modes beat; after them one is left.
TEST(DecayShape, IsReadBehindTheLastTurnOfSeveralModes) {
  std::vector<double> values = {1, 0.4, 0.9};
  for (int n = 0; n < 10; ++n) values.push_back(0.5 * std::exp(-0.1 * n));
  const Decay decay = decay_between_amplitudes(amplitude_series(values), kAny);
  EXPECT_EQ(decay.first, 3u);
  EXPECT_EQ(decay.used, 10u);
  EXPECT_EQ(decay.shape, DecayShape::exponential);
}

}  // namespace
}  // namespace hysteron
