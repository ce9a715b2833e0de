// Every law in a moving cloth: its energy book-keeping, and what a scene can command.
#include <gtest/gtest.h>

#include "sim/bending/laws/law_parameters.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawEntry& law : law_catalogue()) names.push_back(law.name);
  return names;
}

// Returns a free sheet without weight that starts from waves of about the elastic limit, 50/m, and swings.
Trial rippled(const std::string& law, const LawParameters& parameters = {}) {
  Scene scene = test::free_square(150);
  scene.law = law;
  scene.param = parameters;
  scene.gravity.setZero();
  return test::rippled(scene, 3e-2);
}

class EveryLawInMotion : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Laws, EveryLawInMotion, testing::ValuesIn(law_names()), test::CaseName());

// The integrator's share of bending, at the least number of substeps and at four times as many.  It does not
// shrink in proportion: shorter steps damp the fast waves less, and those rub.
TEST_P(EveryLawInMotion, LosesLittleToTheIntegratorAndLessInShorterSteps) {
  const auto gap = [&](int substeps) {
    Trial trial = rippled(GetParam());
    trial.scene.step = 2e-4;
    trial.scene.substeps = substeps * trial.simulation()->limits().substeps;
    const Ledger ledger = trial.after(25)->ledger();
    EXPECT_LT(ledger.remainder_relative, 1e-9);
    return std::abs(ledger.bending_gap) / ledger.initial;
  };
  constexpr double kLittle = 5e-3;
  const double coarse = gap(1), fine = gap(4);
  EXPECT_LT(coarse, kLittle);
  EXPECT_LT(fine, coarse);
}

TEST(Commands, AnEditMakesThePresentShapeTheShapeAtRest) {
  Trial trial = rippled("grinspun-edit");
  const double initial = trial.simulation()->ledger().bending;
  trial.scene.command = {{.kind = CommandKind::edit}};
  const auto edited = trial.after(1);
  const Ledger ledger = edited->ledger();
  EXPECT_GT(initial, 1e-6);
  EXPECT_NEAR(ledger.commands, initial, 1e-12 * initial);
  EXPECT_LT(ledger.bending, 1e-6 * initial);
  EXPECT_LT(ledger.remainder_relative, 1e-9);
  const std::vector<double> k = edited->curvature(), rest = edited->residual_curvature();
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    largest = std::max(largest, std::abs(rest[i]));
    apart = std::max(apart, std::abs(k[i] - rest[i]));
  }
  EXPECT_LT(apart, 1e-2 * largest);
}

// Swung about, so that its history is no longer that of one bend; then one half is ironed.
TEST(Commands, IroningForgetsTheBendsOfItsRegionAlone) {
  Trial trial = rippled("prandtl");
  trial.scene.step = 1e-3;
  const auto creased = trial.after(40)->residual_curvature();
  trial.scene.command = {{.kind = CommandKind::iron, .time = 0.04 - 1e-4, .low = {0.1, -1, -1}}};
  auto simulation = trial.after(39);
  const Ledger before = simulation->ledger();
  EXPECT_EQ(before.commands, 0);
  simulation->advance(1);
  const auto ironed = simulation->residual_curvature();
  const auto centers = trial.cloth.element_centers(3);
  int changed = 0, inside = 0;
  for (std::size_t f = 0; f < centers.size(); ++f) {
    const bool same = Eigen::Map<const Eigen::Vector3d>(&ironed[3 * f]) ==
                      Eigen::Map<const Eigen::Vector3d>(&creased[3 * f]);
    inside += centers[f].x() > 0.1;
    changed += !same;
    if (centers[f].x() > 0.1) {
      EXPECT_FALSE(same);
    }
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(changed, static_cast<int>(centers.size()));  // the other half moves on as it was
  EXPECT_NE(simulation->ledger().commands, 0);
  EXPECT_LT(simulation->ledger().remainder_relative, 1e-9);
}

TEST(FatigueInMotion, TakesMoreMemoryAndLosesMoreThanFrictionAlone) {
  const Trial fresh = rippled("prandtl"), tired = rippled("prandtl", {{"fatigue.dc", "1e-3"}});
  const auto history = [](const Simulation& s) { return test::scene_part(s, "bending history").bytes; };
  const auto a = fresh.after(60), b = tired.after(60);
  EXPECT_EQ(history(*b) - history(*a), fresh.cloth.mesh.faces() * 4 * sizeof(double));  // D and K_p
  EXPECT_GT(b->ledger().bending_friction, 0);
  EXPECT_NE(b->state_hash(), a->state_hash());
  EXPECT_LT(b->ledger().remainder_relative, 1e-9);
}

}  // namespace
}  // namespace hysteron
