// Closed forms of the laws without memory, and of the bilinear one.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/bending/laws/bilinear.h"
#include "sim/bending/laws/bridson.h"
#include "sim/bending/laws/flexion_spring.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/recovery.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kRounding = 1e-15;  // of moments of about 1e-3 N

TEST(Bridson, IsLinearAtFirstAndVanishesWhenFoldedAllTheWayRound) {
  const double h = 5e-3;
  const auto law = Bridson<double, 1>::make(kCotton, h);
  const auto moment = [&](double k) { return law.step(Vec<double, 1>(k), {}).moment[0]; };
  EXPECT_NEAR(moment(1) / kCotton.b2, 1, 2e-6);  // (K h/2)^2/6
  EXPECT_NEAR(moment(100), 2 * kCotton.b2 / h * std::sin(0.25), kRounding);
  EXPECT_NEAR(moment(std::numbers::pi / h), 2 * kCotton.b2 / h,
              kRounding);  // folded flat: the largest moment
  EXPECT_NEAR(moment(2 * std::numbers::pi / h), 0, 10 * kRounding);
  EXPECT_NEAR(law.step(Vec<double, 1>(std::numbers::pi / h), {}).stored, 4 * kCotton.b2 / (h * h), kRounding);
}

// A spring of length 2 h between the tips has E = q (2 h cos(theta/2) - 2 h)^2/2, M = dE/dK.
TEST(FlexionSpring, IsTheSpringBetweenTheTipsOfAHinge) {
  const double h = 5e-3, step = 1e-4;
  const auto law = FlexionSpring<double, 1>::make(kCotton, h);
  const auto at = [&](double k) { return law.step(Vec<double, 1>(k), {}); };
  EXPECT_NEAR(at(kCotton.k0).moment[0], kCotton.b2 * kCotton.k0, kRounding);
  const auto stretch = [&](double k) { return 2 * h * (std::cos(k * h / 2) - 1); };
  const double q = 2 * at(100).stored / std::pow(stretch(100), 2);
  for (double k : {20., 77., 300.}) {
    EXPECT_NEAR(at(k).stored, q * std::pow(stretch(k), 2) / 2, 1e-12 * at(k).stored);
    EXPECT_NEAR(at(k).moment[0], (at(k + step).stored - at(k - step).stored) / (2 * step),
                1e-6 * at(k).moment[0]);
  }
  EXPECT_NEAR(at(0.2).moment[0] / at(0.1).moment[0], 8, 1e-5);  // cubic: nothing holds flat cloth flat
}

TEST(Bilinear, HasTwoSlopesAndUnloadsWithTheFirst) {
  Driven<PrandtlStops<double, 1, 1>> cloth(make_bilinear<double, 1>(kCotton));
  const double ma = kCotton.elastic_limit_moment(), first = ma / kCotton.k0, km = 4 * kCotton.k0;
  EXPECT_NEAR(cloth.moment(kCotton.k0 / 2), ma / 2, kRounding);
  EXPECT_NEAR(cloth.moment(kCotton.k0), ma, kRounding);
  const double mm = cloth.moment(km);
  EXPECT_NEAR(mm, kCotton.friction_moment() + kCotton.b2 * km, kRounding);
  EXPECT_NEAR(cloth.moment(km - kCotton.k0), mm - first * kCotton.k0, kRounding);
  EXPECT_NEAR(cloth.moment(km - 2 * kCotton.k0), mm - 2 * first * kCotton.k0, 10 * kRounding);
  EXPECT_NEAR(cloth.moment(km - 3 * kCotton.k0), mm - 2 * first * kCotton.k0 - kCotton.b2 * kCotton.k0,
              10 * kRounding);
}

TEST(Bilinear, LoopAreaIsThatOfItsStop) {
  Driven<PrandtlStops<double, 1, 1>> cloth(make_bilinear<double, 1>(kCotton));
  const double m = kCotton.friction_moment(), stiffness = m / kCotton.k0;
  EXPECT_NEAR(cloth.cycle_loss(150), 4 * m * (150 - m / stiffness), 1e-13);
}

struct RecoveryLaw {
  const char* name;
  LawParameters parameters;
};

// The closed forms against the law itself, over all three cases and both signs.
TEST(RecoveryFormula, EqualsTheRootOnTheLaw) {
  for (const RecoveryLaw& law :
       {RecoveryLaw{"bilinear", {}}, RecoveryLaw{"wong", {}}, RecoveryLaw{"prandtl", {}},
        RecoveryLaw{"wong", {{"recovery", "reversible"}}}, RecoveryLaw{"pabst", {}}}) {
    const LawRequest request{law.name, kCotton, law.parameters};
    const LawParams choice = choose_law(law.name, kCotton, law.parameters, LawUse::alone);
    ASSERT_TRUE(has_residual_formula(choice));
    for (double k : {0.2, 0.7, 0.99, 1.01, 1.5, 2.2, 3.0, 4.0, 9.0})
      for (double sign : {1., -1.}) {
        const std::vector<LawRow> path = {{sign * k * kCotton.k0}};
        const double moment = run_law(request, path).moment[0];
        EXPECT_NEAR(residual_by_formula(choice, path[0].curvature, moment), residual_after(request, path),
                    1e-10 * kCotton.k0)
            << law.name << " from " << sign * k << " K0";
      }
  }
}

TEST(RecoveryCases, AreDecidedByTheMomentAtTheReversalAndCountedThere) {
  const double ma = kCotton.elastic_limit_moment();
  EXPECT_EQ(recovery_case(kCotton, -ma), RecoveryCase::elastic);
  EXPECT_EQ(recovery_case(kCotton, 1.5 * ma), RecoveryCase::partial);
  EXPECT_EQ(recovery_case(kCotton, 2.01 * ma), RecoveryCase::full_slip);
  // linear: Ma is reached at Ma/b2 = 102.6/m.
  const std::vector<LawRow> rows = {{100}, {50}, {-200}, {-100}, {-100}, {400}, {0}, {10}};
  const RecoveryCounts counts = count_recoveries(kCotton, rows, run_law({"linear", kCotton, {}}, rows));
  EXPECT_EQ(counts.of[0], 1);  // at 100/m; at 0/m nothing is unloaded
  EXPECT_EQ(counts.of[1], 1);  // at -200/m
  EXPECT_EQ(counts.of[2], 1);  // at 400/m
}

// Ma of the back is 2 M0 + 3 b2 K0.
TEST(RecoveryCase, IsThatOfTheSideOfTheMoment) {
  VirginCurve sided = kCotton;
  sided.parts.faces.bending = 3;
  sided.parts.faces.friction = 2;
  const double face = kCotton.elastic_limit_moment();
  const double back = 2 * kCotton.friction_moment() + 3 * kCotton.b2 * kCotton.k0;
  for (const auto& [side, limit] : {std::pair{1.0, face}, {-1.0, back}}) {
    EXPECT_EQ(recovery_case(sided, 0.99 * side * limit), RecoveryCase::elastic) << side;
    EXPECT_EQ(recovery_case(sided, 1.01 * side * limit), RecoveryCase::partial) << side;
    EXPECT_EQ(recovery_case(sided, 2.01 * side * limit), RecoveryCase::full_slip) << side;
  }
}

TEST(RecoveryCase, IsElasticWithoutFrictionWhateverK0) {
  VirginCurve elastic = kCotton;
  elastic.b1 = elastic.b2;
  EXPECT_EQ(recovery_case(elastic, 3 * elastic.elastic_limit_moment()), RecoveryCase::elastic);
  VirginCurve at_once = kCotton;
  at_once.k0 = 0;
  EXPECT_EQ(recovery_case(at_once, kCotton.elastic_limit_moment()), RecoveryCase::elastic);
}

}  // namespace
}  // namespace hysteron::testing
