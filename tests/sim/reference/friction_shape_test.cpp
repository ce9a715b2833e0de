// Friction of two numbers: what the virtual KES-FB2 reads of it.  Loops and losses are those of any spectrum.
#include "sim/bending/laws/friction_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "sim/bending/laws/law_run.h"
#include "sim/reference/kes.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron {
namespace {

LawRequest stops_request(const ShapedFriction& friction, const std::string& name = "prandtl") {
  return {name, {friction.b2 + friction.stops.stiffness(), friction.b2, 1, {friction.stops, {}, {}, {}}}, {}};
}

ShapedFriction cotton() { return friction_from_kes({1.157e-5, 1.216e-3}, {17, 2}); }

KesReading read(const LawRequest& law) {
  KesProtocol protocol;
  protocol.cycles = 1;
  protocol.minor_loops = false;
  const KesWalk walk = walk_to({protocol.amplitude, -protocol.amplitude, protocol.amplitude}, protocol);
  return read_loop(protocol, walk, run_law(law, walk.rows).moment);
}

// Fabrics as they are measured: B of 1 to 50 uN m, HB/B of 5 to 60 per m (the pairs of validation.md: 18 to
// 53).
TEST(FrictionShape, IsReadByTheTesterAsItWasMade) {
  std::mt19937 random(3);
  const auto log_uniform = [&](double low, double high) {
    return low * std::exp(std::uniform_real_distribution<double>(0, std::log(high / low))(random));
  };
  int made = 0;
  for (int draw = 0; draw < 50; ++draw) {
    const double b = log_uniform(1e-6, 5e-5), hb = b * log_uniform(5, 60);
    const FrictionShape shape{log_uniform(3, 80), log_uniform(0.3, 3)};
    const ShapedFriction friction = friction_from_kes({b, 2 * hb}, shape);
    if (!(friction.b2 > 0)) continue;
    ++made;
    const KesReading reading = read(stops_request(friction));
    EXPECT_NEAR(reading.rigidity / b, 1, 5e-3) << shape.median << " " << shape.spread;
    EXPECT_NEAR(reading.loop_width / (2 * hb), 1, 5e-3) << shape.median << " " << shape.spread;
    const KesPair closed = kes_pair(friction.b2, friction.stops);
    EXPECT_NEAR(closed.rigidity / b, 1, 1e-12);
    EXPECT_NEAR(closed.loop_width / (2 * hb), 1, 1e-12);
  }
  EXPECT_GT(made, 40);
}

// Matsudaira, Masuda, Wada, Yokura 2015, quoted second-hand (assets/fabrics), and the denims A to F of Kumari
// & Khurana 2016, Table 5: B [gf cm^2/cm], 2HB [gf cm/cm].
TEST(FrictionShape, GivesTenPublishedPairsBack) {
  constexpr std::pair<double, double> kPairs[] = {
      {0.118, 0.124}, {0.067, 0.033}, {0.077, 0.029}, {0.019, 0.007}, {0.172, 0.139},
      {0.144, 0.142}, {0.227, 0.105}, {0.147, 0.141}, {0.207, 0.214}, {0.148, 0.159}};
  for (const auto& [printed_b, printed_width] : kPairs) {
    const double b = printed_b * kGramForceSquareCentimetrePerCentimetre,
                 width = printed_width * kGramForceCentimetrePerCentimetre;
    const KesReading reading = read(stops_request(friction_from_kes({b, width}, {17, 2})));
    EXPECT_NEAR(reading.rigidity / b, 1, 5e-3) << printed_b;
    EXPECT_NEAR(reading.loop_width / width, 1, 5e-3) << printed_b;
  }
}

TEST(FrictionShape, HasHalfOfItsMomentBelowTheMedianAndItsSpread) {
  const Spectrum stops = shaped_stops({17, 2}, 6e-4);
  double below = 0, mean = 0, square = 0;
  for (std::size_t j = 0; j < stops.size(); ++j) {
    const double moment = stops.thresholds[j] * stops.stiffnesses[j],
                 z = std::log(stops.thresholds[j] / 17) / 2;
    EXPECT_NEAR(moment, 6e-4 / 8, 1e-18);
    below += stops.thresholds[j] < 17 ? moment : 0;
    mean += z / 8, square += z * z / 8;
  }
  EXPECT_NEAR(below, 3e-4, 1e-18);
  EXPECT_NEAR(stops.friction_moment(), 6e-4, 1e-18);
  EXPECT_NEAR(mean, 0, 1e-15);
  EXPECT_NEAR(square, 1, 0.15) << "eight quantiles have less than the whole distribution's variance";
  EXPECT_TRUE(std::is_sorted(stops.thresholds.begin(), stops.thresholds.end()));
}

TEST(FrictionShape, WithoutSpreadIsOneStop) {
  const Spectrum stops = shaped_stops({20, 0}, 1e-4);
  for (const double r : stops.thresholds) EXPECT_DOUBLE_EQ(r, 20);
  EXPECT_NEAR(stops.stiffness(), 1e-4 / 20, 1e-18);
}

// Friction that wears off keeps the shape: it starts with the tester's pair.
TEST(FrictionShape, CanWeaken) {
  LawRequest law = stops_request(cotton());
  law.curve.k0 = 2 * cotton().stops.friction_moment() / cotton().stops.stiffness();
  law.parameters = {{"fatigue.dc", "1e9"}, {"fatigue.m-inf", "1e-4"}};
  EXPECT_NEAR(read(law).loop_width / 1.216e-3, 1, 5e-3);
  law.parameters["fatigue.dc"] = "1e-3";
  EXPECT_LT(read(law).loop_width / 1.216e-3, 0.5);
}

}  // namespace
}  // namespace hysteron
