// Stops come back from the loops of a FAB tester that they make, with noise.
#include "sim/identification/fab_bending.h"
#include "sim/identification/form_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/identification/fab_tension.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

constexpr unsigned kFabSeeds = 3;
constexpr double kWidth = 0.04, kDensity = 0.3, kNoise = 7.5e-4;  // [m], [kg/m^2], [N]
const StopsLaw kLaw{4e-6, {4, 16, 64}, {2e-5, 2e-6, 8e-7}};

// Returns loops as a tester records them: rows every half millimetre, an unknown zero of force.
FabLoops recorded(const StopsLaw& law, const std::string& test, unsigned seed, double noise = kNoise) {
  FabLoops loops = made_up_loops(test, 0.021, 0.0015, {0.0039, 0.0064, 0.0089}, 13);
  loops.direction = "L";
  loops.width = kWidth;
  const BranchForces force = run_fab(loops, {law, law, kDensity}).force;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise / kWidth);
  for (std::size_t b = 0; b < force.size(); ++b)
    for (std::size_t i = 0; i < force[b].size(); ++i)
      loops.branches[b].force[i] = force[b][i] + 0.1 + normal(random);
  return loops;
}

FabBendingQuestion bending_question() {
  FabBendingQuestion bending_question;
  bending_question.thresholds = kLaw.thresholds;
  bending_question.density = kDensity;
  return bending_question;
}

// Three standard errors of the logarithm, whose prior and likelihood are nearly normal.
bool within(double found, double truth, double error) {
  return std::abs(std::log(found / truth)) <= 3 * error / found;
}

TEST(FabBending, ComesBackFromNoiseWithinThreeStandardErrors) {
  int checks = 0, misses = 0;
  const auto check = [&](bool hit) { ++checks, misses += !hit; };
  for (unsigned seed = 1; seed <= kFabSeeds; ++seed) {
    const FabBending found = identify_fab_bending({recorded(kLaw, "D1", seed)}, bending_question());
    EXPECT_TRUE(found.converged) << seed;
    check(within(found.law.spring, kLaw.spring, found.spring_error));
    check(within(found.law.friction(), kLaw.friction(), found.friction_error));
    check(std::abs(found.zero[0] - 0.1) <= 3 * found.zero_errors[0]);
    for (int j = 0; j < kLaw.stops(); ++j)
      check(within(found.law.stiffnesses[j], kLaw.stiffnesses[j], found.stiffness_errors[j]));
  }
  EXPECT_LE(misses, 1 + checks / 100);  // of 18 at 99.7 %, two are one case in 700
}

// Areas of the cycles that were not fitted, and of the bend to the other side.
TEST(FabBending, FromOneCyclePredictsTheOthersAndTheBendUp) {
  const FabBending found = identify_fab_bending({recorded(kLaw, "D1", 7)}, bending_question());
  const double tolerance = 3 * found.friction_error / found.law.friction();  // areas grow with friction
  EXPECT_LT(tolerance, 0.5);
  for (const char* test : {"D1", "U1"}) {
    const FabLoops truth = recorded(kLaw, test, 1, 0);
    const BranchForces predicted = run_fab(truth, {found.law, {}, kDensity}).force;
    for (int cycle = 0; cycle < 3; ++cycle) {
      const double area = loop_area(truth, branch_forces(truth), cycle);
      EXPECT_NEAR(loop_area(truth, predicted, cycle) / area, 1, tolerance) << test << " " << cycle;
    }
  }
}

TEST(FabBending, SaysThatACycleDoesNotTellStopsBeyondIt) {
  FabBendingQuestion wide = bending_question();
  wide.thresholds.push_back(512);
  const FabBending found = identify_fab_bending({recorded(kLaw, "D1", 3)}, wide);
  EXPECT_FALSE(found.determined.back());
  EXPECT_EQ(found.undetermined().back(), "stop 512/m");
  EXPECT_GT(found.law.spring, 0.3 * kLaw.spring);
}

TEST(FabBending, OfOneStopIsTheBestOfTheGrid) {
  const StopsLaw one{3e-6, {16}, {8e-6}};
  EXPECT_EQ(identify_one_stop({recorded(one, "D1", 5)}, bending_question()).law.thresholds, one.thresholds);
}

// Its loop encloses nothing but noise, from which its rigidity does not follow.
TEST(FabBending, OfAStripWithoutFrictionFindsItsRigidity) {
  const StopsLaw elastic{6e-6, {}, {}};
  const FabBending found = identify_fab_bending({recorded(elastic, "D1", 2)}, bending_question());
  EXPECT_NEAR(found.law.spring / elastic.spring, 1, 3 * found.spring_error / found.law.spring);
  EXPECT_LT(found.spring_error, 0.2 * found.law.spring);
  EXPECT_LT(found.residual_rms, 1.5);
  EXPECT_LT(found.law.friction(), kNoise / kWidth * 0.021) << "the noise over the gauge";
}

// A form whose 0 lies where the least squares have a false minimum: friction that slips about 700/m, beyond
// what the loops reach, with a spread that brings some of it back.
TEST(FabBending, TakesTheDeepestOfTheMinimaThatItsStartsLeadTo) {
  const Eigen::Vector3d far(1.2, std::log(70), std::log(2.2));
  FrictionForm form = shaped_friction();
  form.stops = [=](const Eigen::VectorXd& p, double moment) {
    return shaped_friction().stops(p + far, moment);
  };
  form.largest = {};
  const std::vector<Eigen::VectorXd> starts = form.starts;
  FabBendingQuestion one_start = bending_question();
  form.starts = {};
  one_start.form = form;
  const Spectrum even = parabola_stops(3e-5, 40);
  const FabLoops loops = recorded({1e-5, even.thresholds, even.stiffnesses}, "D1", 1, 0);
  EXPECT_GT(identify_fab_bending({loops}, one_start).residual_rms, 0.5);
  FabBendingQuestion several = one_start;
  several.form->starts = {starts[2] - far};
  const FabBending found = identify_fab_bending({loops}, several);
  EXPECT_LT(found.residual_rms, 0.25);
  EXPECT_NEAR(found.law.friction() / even.friction_moment(), 1, 0.1) << "of another form of friction";
}

// Half of the friction of the shape slips within the largest change of curvature, and its spread is one that
// a fabric's file may have: the bounds of the search.
TEST(FabBending, SeeksNoFrictionBeyondWhatItsLoopsReach) {
  const FabBending found = [] {
    FabBendingQuestion shaped = bending_question();
    shaped.form = shaped_friction();
    shaped.form->starts = {};
    return identify_fab_bending({recorded({6e-6, {900}, {4e-5}}, "D1", 1)}, shaped);
  }();
  EXPECT_GT(found.reach, 100);
  EXPECT_LT(found.reach, 300) << "2 pi sqrt(slack)/(L/2) at 0.0064 m, less that at 0.0015 m, is 189/m";
  EXPECT_LE(friction_shape(found.form).median, 1.0001 * found.reach);
  EXPECT_LE(friction_shape(found.form).spread, 4.0001);
}

FabBending found_with(double friction, double residual_rms) {
  FabBending found;
  found.direction = "L";
  found.law = {1e-5, {10, 1000}, {friction / 20, friction / 2000}};  // half of HB at each
  found.spring_error = 1e-6;
  found.friction_error = 0.1 * friction;
  found.determined = {true, true, true};
  found.rows = 50;
  found.residual_rms = residual_rms;
  found.residuals = Eigen::VectorXd(50);
  for (int i = 0; i < 50; ++i) found.residuals[i] = i % 2 ? residual_rms : -residual_rms;
  return found;
}

TEST(FabBending, KnowsFrictionOnlyAsFarAsItsLoopsReach) {
  FabBending found = found_with(1e-3, 1);
  found.reach = 2000;
  EXPECT_NEAR(found.friction_within_reach(), 1e-3, 1e-15);
  EXPECT_TRUE(found.knows_friction());
  found.reach = 100;
  EXPECT_NEAR(found.friction_within_reach(), 5e-4, 1e-15);
  found.law.stiffnesses[1] *= 4;  // a fifth of HB is within reach, and kWidestFactor is 3
  EXPECT_FALSE(found.knows_friction());
}

// One other form that is as likely has a weight of a half; one that is excluded has none.
TEST(FabBending, WidensItsErrorsByWhatEquallyLikelyFormsFind) {
  FabBending found = found_with(1e-3, 1);
  widen_errors(found, {{"another", found_with(2e-3, 1)}, {"excluded", found_with(9e-3, 10)}});
  EXPECT_NEAR(found.friction_error / 1e-3, std::hypot(0.1, std::log(2) / std::sqrt(2)), 1e-6);
  EXPECT_NEAR(found.spring_error, 1e-6, 1e-12) << "all find the same b2";
  FabBending worse = found_with(1e-3, 10);
  widen_errors(worse, {{"far better", found_with(2e-3, 1)}});
  EXPECT_NEAR(worse.friction_error / 1e-3, std::hypot(0.1, std::log(2)), 1e-6);
}

TEST(FabBending, RefusesACycleThatIsNotThere) {
  FabBendingQuestion beyond = bending_question();
  beyond.cycles = {4};
  EXPECT_TRUE(
      test::says(test::refusal([&] { identify_fab_bending({recorded(kLaw, "D1", 1)}, beyond); }), "1 to 3"));
}

TEST(FabTension, ComesBackFromNoiseWithinThreeStandardErrors) {
  FabTensionQuestion requested;
  requested.thresholds = {0.005, 0.03};
  const StopsLaw law{60, requested.thresholds, {300, 40}};
  for (unsigned seed = 1; seed <= kFabSeeds; ++seed) {
    FabLoops loops = recorded(law, "S1", seed, requested.noise);
    const FabTension found = identify_fab_tension({loops}, requested);
    EXPECT_TRUE(within(found.law.spring, law.spring, found.spring_error)) << seed;
    for (int j = 0; j < law.stops(); ++j)
      EXPECT_TRUE(within(found.law.stiffnesses[j], law.stiffnesses[j], found.stiffness_errors[j]))
          << seed << ", stop " << j;
  }
}

}  // namespace
}  // namespace hysteron
