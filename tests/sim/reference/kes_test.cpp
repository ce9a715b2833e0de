#include "sim/reference/kes.h"

#include <cmath>

#include "sim/bending/laws/recovery.h"
#include "sim/scene/fabric_reader.h"
#include "tests/sim/base/case_name.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

const VirginCurve kCotton{3.5892339e-5, 1.1571847e-5, 50};

constexpr double kKesRounding = 1e-9;  // relative: sums of some thousand rows
constexpr double kPublished = 0.01;    // relative: what a fabric's test must give back
constexpr double kSampling = 1e-4;     // relative: what halving the steps may change in a reading

std::vector<std::string> all_laws() {
  std::vector<std::string> names;
  for (const LawEntry& law : law_catalogue()) names.push_back(law.name);
  return names;
}

// Where linear interpolation between two rows can miss the root of a curved branch: h^2 |M''|/(8 M') with
// |M''| <= (b1 - b2)/K0 and M' >= b2.
double root_tolerance(const VirginCurve& curve, const KesProtocol& p) {
  const double h = p.amplitude / p.steps;
  return h * h * (curve.b1 - curve.b2) / (8 * curve.k0 * curve.b2);
}

class PublishedPair : public testing::TestWithParam<std::string> {};

TEST_P(PublishedPair, ComesBackFromPrandtlAndWong) {
  const Fabric fabric = read_fabric(GetParam(), "test").fabric;
  const double b = fabric.published.at("B").value * kGramForceSquareCentimetrePerCentimetre;
  const double width = fabric.published.at("2HB").value * kGramForceCentimetrePerCentimetre;
  for (const char* law : {"prandtl", "wong"}) {
    const KesReading reading = test_in_kes({law, fabric.virgin_curve(), {}}).reading;
    EXPECT_NEAR(reading.rigidity, b, kPublished * b) << law;
    EXPECT_NEAR(reading.loop_width, width, kPublished * width) << law;
    // With K0 at the window's lower end the test is exact, not only within a percent.
    EXPECT_NEAR(reading.rigidity, fabric.b2, kKesRounding * b) << law;
    EXPECT_NEAR(reading.residual, width / 2 / b, kPublished * width / 2 / b) << law;
  }
}

// Whatever has the larger B and the larger 2HB.
TEST(KesOfFaces, ReadsBothPairsBack) {
  constexpr double kReads = 5e-3;
  for (const double k0 : {8.0, 50.0})
    for (const double bending : {0.6, 1.0, 1.7})
      for (const double friction : {0.6, 1.0, 1.7}) {
        VirginCurve fabric = kCotton;
        fabric.b1 = fabric.b2 + 2 * kCotton.friction_moment() / k0, fabric.k0 = k0;
        fabric.parts.faces = {bending, friction};
        const KesReading reading = test_in_kes({"prandtl", fabric, {}}).reading;
        const double width = 2 * kCotton.friction_moment();
        EXPECT_NEAR(reading.face.rigidity / fabric.b2, 1, kReads) << k0 << " " << bending << " " << friction;
        EXPECT_NEAR(reading.face.loop_width / width, 1, kReads);
        EXPECT_NEAR(reading.back.rigidity / (bending * fabric.b2), 1, kReads)
            << k0 << " " << bending << " " << friction;
        EXPECT_NEAR(reading.back.loop_width / (friction * width), 1, kReads);
      }
}

// Laws without sides have the means of both.
TEST(KesOfFaces, ReadsTheMeanOfLawsWithoutSides) {
  VirginCurve fabric = kCotton;
  fabric.parts.faces = {1.5, 0.6};
  for (const char* law : {"wong", "bilinear"}) {
    const KesReading reading = test_in_kes({law, fabric, {}}).reading;
    EXPECT_NEAR(reading.rigidity / (1.25 * fabric.b2), 1, kPublished) << law;
    EXPECT_NEAR(reading.loop_width / (0.8 * 2 * fabric.friction_moment()), 1, kPublished) << law;
  }
}

INSTANTIATE_TEST_SUITE_P(Kes, PublishedPair,
                         testing::Values("cotton-broad-k50", "wool-tropical-k50", "polyester-tropical-k50",
                                         "polyester-faille-k50"),
                         test::CaseName());

class AnyLaw : public testing::TestWithParam<std::string> {};

TEST_P(AnyLaw, IsReadTheSameWithHalfTheSteps) {
  KesProtocol fine, coarse;
  fine.minor_loops = coarse.minor_loops = false;
  coarse.steps = fine.steps / 2;
  const KesReading a = test_in_kes({GetParam(), kCotton, {}}, fine).reading;
  const KesReading b = test_in_kes({GetParam(), kCotton, {}}, coarse).reading;
  EXPECT_NEAR(a.rigidity, b.rigidity, kSampling * kCotton.b2);
  EXPECT_NEAR(a.loop_width, b.loop_width, kSampling * 2 * kCotton.friction_moment());
  EXPECT_NEAR(a.residual, b.residual, kSampling * fine.amplitude);
  EXPECT_NEAR(a.loop_area, b.loop_area, kSampling * 4 * kCotton.friction_moment() * fine.amplitude);
}

TEST_P(AnyLaw, HasEveryReversalOfEveryLoopClassified) {
  KesProtocol p;
  p.steps = 200;
  const KesTest test = test_in_kes({GetParam(), kCotton, {}}, p);
  const int reversals_per_cycles = 2 * p.cycles, amplitudes = 5, partial = 4;
  EXPECT_EQ(test.recovery_cases[0] + test.recovery_cases[1] + test.recovery_cases[2],
            reversals_per_cycles * (1 + amplitudes) + 2 * partial);
  EXPECT_EQ(test.minor_loops.size(), static_cast<std::size_t>(amplitudes + partial));
}

INSTANTIATE_TEST_SUITE_P(Kes, AnyLaw, testing::ValuesIn(all_laws()), test::CaseName());

TEST(Kes, ElasticLawsHaveNeitherWidthNorAreaNorResidual) {
  for (const char* law : {"linear", "bridson", "spring", "pabst"}) {
    const KesTest test = test_in_kes({law, kCotton, {}});
    EXPECT_NEAR(test.reading.loop_width, 0, kKesRounding * kCotton.friction_moment()) << law;
    EXPECT_EQ(test.reading.loop_area, 0) << law;
    EXPECT_NEAR(test.reading.residual, 0, kKesRounding) << law;
    EXPECT_EQ(test.reading.residual_by_formula, 0) << law;
  }
}

TEST(Kes, LoopAreaIsTheClosedFormBelowAndAboveTheElasticLimit) {
  const double m0 = kCotton.friction_moment(), k0 = kCotton.k0;
  for (const char* law : {"prandtl", "wong"}) {
    const double area = test_in_kes({law, kCotton, {}}).reading.loop_area;
    EXPECT_NEAR(area, 4 * m0 * (250 - 2 * k0 / 3), kSampling * area) << law;
  }
  KesProtocol small;
  small.amplitude = 40, small.slope_from = 10, small.slope_to = 30, small.width_at = 20;
  const double area = test_in_kes({"prandtl", kCotton, {}}, small).reading.loop_area;
  EXPECT_NEAR(area, 4.0 / 3 * -kCotton.c1() * 40 * 40 * 40, kSampling * area);
}

// Ten steps pass the corners of the loop; what happens between them is known.
TEST(Kes, ReadsTheLoopBetweenCoarseSteps) {
  for (const double k0 : {5.0, 50.0}) {
    const VirginCurve cotton{1.1571847e-5 + 1.216e-3 / k0, 1.1571847e-5, k0};
    KesProtocol p;
    p.steps = 10;
    const KesTest coarse = test_in_kes({"prandtl", cotton, {}}, p);
    const double area = 4 * cotton.friction_moment() * (p.amplitude - 2 * k0 / 3);
    EXPECT_NEAR(coarse.reading.loop_area, area, kSampling * area) << k0;
    EXPECT_NEAR(coarse.reading.rigidity, cotton.b2, kKesRounding * cotton.b2) << k0;
    EXPECT_EQ(coarse.walk.rows.size(), 1 + 10 + 1 + static_cast<std::size_t>(2 * p.cycles) * (20 + 1));
    EXPECT_EQ(coarse.area_error, 0);
  }
}

// A law that creeps is another one with longer steps, and says so.
TEST(Kes, KnowsHowCoarseTheStepsOfALawAreThatTakesTime) {
  KesProtocol coarse, fine;
  coarse.steps = 10, fine.steps = 1000;
  const KesTest test = test_in_kes({"kim", kCotton, {}}, coarse);
  const double area = test_in_kes({"kim", kCotton, {}}, fine).reading.loop_area;
  EXPECT_DOUBLE_EQ(test.area_error, test.reading.loop_area / area - 1);
  EXPECT_NE(test.area_error, 0);
}

// At u = width_at/K0 < 1 the loading branch of the positive side is still the virgin curve, F = M0 (2u -
// u^2); everywhere else the friction at +-width_at has come to +-M0.
TEST(Kes, WidthReadOnTheVirginCurveIsSmallerByItsMissingFriction) {
  KesProtocol p;
  p.width_at = 25;
  const double u = p.width_at / kCotton.k0, m0 = kCotton.friction_moment();
  const double positive = m0 * (2 * u - u * u) + m0, negative = 2 * m0;
  const double width = test_in_kes({"prandtl", kCotton, {}}, p).reading.loop_width;
  EXPECT_NEAR(width, (positive + negative) / 2, kKesRounding * m0);
}

TEST(Kes, ResidualCurvatureByRootIsTheOneByFormulaInAllThreeCases) {
  const double amplitudes[] = {40, 100, 250};
  for (const char* law : {"bilinear", "prandtl", "wong"}) {
    for (int i = 0; i < 3; ++i) {
      KesProtocol p;
      p.amplitude = amplitudes[i];
      p.slope_from = 0.2 * p.amplitude, p.slope_to = 0.6 * p.amplitude, p.width_at = 0.4 * p.amplitude;
      const KesTest test = test_in_kes({law, kCotton, {}}, p);
      const double moment = test.moment[test.walk.start[1] - 1];
      EXPECT_EQ(static_cast<int>(recovery_case(kCotton, moment)), i + 1) << law << " " << p.amplitude;
      EXPECT_NEAR(test.reading.residual, test.reading.residual_by_formula,
                  root_tolerance(kCotton, p) + kKesRounding)
          << law << " " << p.amplitude;
    }
  }
}

TEST(Kes, ResidualAfterAnEditAtFullAmplitudeIsTheAmplitude) {
  const KesTest test = test_in_kes({"grinspun-edit", kCotton, {}});
  EXPECT_EQ(test.reading.residual, 250);
  EXPECT_TRUE(std::isnan(test.reading.residual_by_formula));
}

TEST(KesWalk, VisitsEveryTurnAtTheTestersRateAndCommandsAtFullAmplitudeOnly) {
  const KesProtocol p;
  const KesWalk walk = walk_to({250, 100, 250}, p);
  double seconds = 0;
  int edits = 0;
  for (const LawRow& row : walk.rows) {
    seconds += row.seconds;
    edits += row.edit;
    EXPECT_TRUE(!row.edit || row.curvature == 250) << row.curvature;
  }
  EXPECT_NEAR(seconds, (250 + 150 + 150) / p.rate, kKesRounding * seconds);
  EXPECT_EQ(edits, 2);
  const double turns[] = {0, 250, 100, 250};
  ASSERT_EQ(walk.start.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(walk.rows[walk.start[i]].curvature, turns[i]);
}

TEST(KesMinorLoops, OfPrandtlClose) {
  for (const MinorLoop& loop : test_in_kes({"prandtl", kCotton, {}}).minor_loops) {
    EXPECT_EQ(loop.curvature.front(), loop.curvature.back());
    EXPECT_NEAR(loop.moment.front(), loop.moment.back(), kKesRounding * kCotton.friction_moment())
        << loop.reversal;
    EXPECT_GT(loop.curvature.size(), 2u);
  }
}

TEST(KesProtocol, ThatCannotBeReadIsRefusedWithItsNumbers) {
  KesProtocol outside, reversed, wide;
  outside.slope_to = 300;
  reversed.slope_from = 150;
  wide.width_at = 250;
  for (const KesProtocol& p : {outside, reversed, wide})
    EXPECT_TRUE(test::says(test::refusal([&] { check_protocol(p); }), "250 1/m"));
}

// The tester reads a fabric's own stops within its window and its amplitude.
TEST(Kes, ReadsTheStopsOfAFabricByTheirClosedForms) {
  const double b2 = 1e-5;
  const Spectrum stops{{3, 12, 40, 95, 300}, {9e-6, 7e-6, 3e-6, 1e-6, 4e-7}};
  const VirginCurve fabric{3e-5, b2, 50, {stops, {}, {}, {}}};
  const auto virgin = [&](double k) { return b2 * k + stops.friction_at(k); };
  const KesProtocol p;
  const KesReading read = test_in_kes({"prandtl", fabric, {}}).reading;
  constexpr double kRows = 1e-3;  // of the tester's 20,000 steps, between which moments are interpolated
  EXPECT_NEAR(read.loop_area, stops.loop_area(p.amplitude), kRows * read.loop_area);
  // The first loop begins on the virgin curve, on which the widest stop has slipped less than in a closed
  // one.
  const double up = virgin(100), down = virgin(250) - 2 * virgin(75);
  const double back = -virgin(250) + 2 * virgin(75), lower = virgin(250) - 2 * virgin(175);
  EXPECT_NEAR(read.loop_width, (up - down + back - lower) / 2, kRows * read.loop_width);
  const double loading = (virgin(150) - virgin(50)) / 100, unloading = 2 * (virgin(200) - virgin(150)) / 100;
  EXPECT_NEAR(read.rigidity, (loading + unloading) / 2, kRows * b2);
  EXPECT_NEAR(kes_pair(fabric).rigidity, (loading + unloading) / 2, kKesRounding * b2);
  EXPECT_NEAR(kes_pair(fabric).loop_width, (up - down + back - lower) / 2, kKesRounding * read.loop_width);
}

// A comparison of these laws is one of memory: the tester reads the same B and 2HB of all of them.
TEST(KesFabric, ReadsItsPublishedPairUnderEveryLawOfThreeNumbers) {
  constexpr double kRead = 5e-3;  // relative; dahl nears its friction moment exponentially
  KesProtocol protocol;
  protocol.cycles = 1;
  protocol.minor_loops = false;
  const KesWalk walk = walk_to({250, -250, 250}, protocol);
  for (const char* name :
       {"cotton-broad", "wool-tropical", "polyester-tropical", "polyester-faille", "denim-c-friction"}) {
    const Fabric fabric = read_fabric(name, "test").fabric;
    const double b = fabric.published.at("B").value * kGramForceSquareCentimetrePerCentimetre,
                 width = fabric.published.at("2HB").value * kGramForceCentimetrePerCentimetre;
    for (const char* law : {"prandtl", "wong", "bilinear", "dahl", "chapman"}) {
      const KesReading read =
          read_loop(protocol, walk, run_law({law, fabric.virgin_curve(), {}}, walk.rows).moment);
      EXPECT_NEAR(read.rigidity / b, 1, kRead) << name << " " << law;
      EXPECT_NEAR(read.loop_width / width, 1, kRead) << name << " " << law;
    }
  }
}

}  // namespace
}  // namespace hysteron
