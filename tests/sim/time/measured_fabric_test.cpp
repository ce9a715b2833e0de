// Cloth whose fabric has more than three numbers: stops, relaxing branches and a set in motion.
#include <gtest/gtest.h>

#include <map>

#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Method;
using test::Trial;

// Returns a free sheet without weight that starts from waves and swings.
Trial rippled(const Method& method, const BendingParts& parts) {
  Scene scene = test::free_square(60);
  scene.law = method.law;
  scene.element = value_named<BendingElement>(method.element);
  scene.integrator = value_named<Integrator>(method.integrator);
  scene.fabric.bending = parts;
  scene.gravity.setZero();
  scene.step = 1e-3;
  return test::rippled(scene, 3e-2);
}

class MeasuredFabric : public testing::TestWithParam<Method> {};
const Method kMeasuredCases[] = {{"chapman", "shape", "semi-implicit"}, {"chapman", "hinge", "semi-implicit"},
                                 {"chapman", "shape", "explicit"},      {"chapman", "hinge", "implicit"},
                                 {"chapman", "shape", "bdf2"},          {"chapman", "shape", "tr-bdf2"},
                                 {"prandtl", "shape", "tr-bdf2"},       {"prandtl", "hinge", "implicit"}};

INSTANTIATE_TEST_SUITE_P(Methods, MeasuredFabric, testing::ValuesIn(kMeasuredCases), test::CaseName());

// This struct has the losses by friction and relaxation after six steps, each of which closes the balance and
// gives nothing back.
struct Lost {
  double friction = 0, relaxed = 0;
};
Lost lost_in_motion(const Trial& trial) {
  constexpr double kArithmetic = 1e-9;
  constexpr double kRounding = 1e-12;  // of the stored energy, whose change less work a loss is
  const auto simulation = trial.simulation();
  Lost lost;
  for (int step = 0; step < 6; ++step) {
    simulation->advance(1);
    const Ledger ledger = simulation->ledger();
    EXPECT_LT(ledger.remainder_relative, kArithmetic);
    const double rounding = kRounding * ledger.bending;
    EXPECT_GE(ledger.bending_friction, lost.friction - rounding);
    EXPECT_GE(ledger.bending_relaxation, lost.relaxed - rounding);
    lost = {ledger.bending_friction, ledger.bending_relaxation};
  }
  return lost;
}

TEST_P(MeasuredFabric, LosesEnergyToFrictionAndRelaxationInABalanceThatCloses) {
  const Lost lost = lost_in_motion(rippled(GetParam(), test::all_parts()));
  EXPECT_GT(lost.friction, 0);
  EXPECT_EQ(lost.relaxed > 0, GetParam().law == "chapman");
}

class FacesInMotion : public testing::TestWithParam<Method> {};
const Method kFacesCases[] = {{"prandtl", "shape", "semi-implicit"},
                              {"prandtl", "hinge", "semi-implicit"},
                              {"prandtl", "shape", "tr-bdf2"},
                              {"prandtl", "hinge", "implicit"},
                              {"linear", "shape", "implicit"}};
INSTANTIATE_TEST_SUITE_P(Methods, FacesInMotion, testing::ValuesIn(kFacesCases), test::CaseName());

TEST_P(FacesInMotion, LoseEnergyToFrictionInABalanceThatCloses) {
  BendingParts parts;
  parts.faces = {1.4, 0.7};
  Trial trial = rippled(GetParam(), parts);
  trial.scene.fabric.weft_friction = 0.8;
  EXPECT_EQ(lost_in_motion(trial).friction > 0, GetParam().law == "prandtl");
}

// With its face down the sheet moves as the fabric of inverted ratios does with its face up.
TEST(FacesInMotion, AreThoseOfTheMirroredFabricOnTheOtherSide) {
  constexpr double kSolves = 1e-7;  // of the waves' height
  for (const char* element : {"shape", "hinge"}) {
    const auto moved = [&](bool turned) {
      BendingParts parts;
      parts.faces = {1.4, 0.7};
      Trial trial = rippled({"prandtl", element, "implicit"}, parts);
      trial.scene.fabric.damping = 0;  // which is times b1
      trial.scene.newton_residual = 1e-11;
      trial.scene.newton_velocity = 0;
      if (turned) {
        Fabric& fabric = trial.scene.fabric;
        const double friction = 0.7 * (fabric.b1 - fabric.b2);
        fabric.b2 *= 1.4, fabric.b1 = fabric.b2 + friction;
        fabric.bending.faces = {1 / 1.4, 1 / 0.7};
        for (Eigen::Vector3d& x : trial.cloth.start) x.z() = -x.z();
      }
      return trial.after(10)->positions();
    };
    const test::Positions one = moved(false), other = moved(true);
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_NEAR(one[i].z(), -other[i].z(), kSolves * 3e-2) << element;
  }
}

// Its history is what its type has: 8 stops for each component here, 5 more vectors with branches, one with
// set.
TEST(MeasuredFabric, PaysForThePartsThatItHasAlone) {
  const auto bytes = [](const char* law, const BendingParts& parts) {
    const Trial trial = rippled({law, "shape", "semi-implicit"}, parts);
    return test::scene_part(*trial.simulation(), "bending history").bytes / trial.cloth.mesh.faces() /
           (3 * sizeof(double));
  };
  const BendingParts all = test::all_parts();
  EXPECT_EQ(bytes("prandtl", {}), 8u);
  EXPECT_EQ(bytes("prandtl", {all.stops, {}, {}, {}}), 8u);
  EXPECT_EQ(bytes("chapman", {all.stops, {}, all.branches, {}}), 8u + 5);
  EXPECT_EQ(bytes("prandtl", {all.stops, {}, {}, all.set}), 8u + 1);
  EXPECT_EQ(bytes("chapman", all), 8u + 5 + 1);
}

// Two numbers of each hinge's direction, where the fabric's stops have one.
TEST(MeasuredFabric, PaysForDirectionsOfHingesWhereItsStopsDifferByThem) {
  const BendingParts all = test::all_parts();
  std::map<std::string, std::size_t> more, one;
  const auto count_parts = [](const BendingParts& parts, std::map<std::string, std::size_t>& bytes) {
    const Trial trial = rippled({"prandtl", "hinge", "semi-implicit"}, parts);
    for (const ScenePart& part : trial.simulation()->parts()) bytes[part.name] = part.bytes;
    return trial.cloth.mesh.interior_edges;
  };
  const int hinges = count_parts({all.stops, {}, {}, {}}, one);
  count_parts({all.stops, all.weft_stops, {}, {}}, more);
  EXPECT_EQ(more["bending"] - one["bending"], 2 * sizeof(double) * hinges);
  EXPECT_EQ(more["bending history"], 8 * sizeof(double) * hinges);
  EXPECT_EQ(one["bending history"], more["bending history"]);
}

// A sheet with one relaxing branch, held in waves that it is not at rest in.
Trial held_in_waves(const char* integrator, double tau) {
  Trial trial = rippled({"chapman", "shape", integrator}, {{}, {}, {{tau}, {6e-6}}, {}});
  trial.scene.pin = {test::pin_in({-1, -1, -1}, {1, 1, 1})};
  const std::vector<Eigen::Vector3d> start = trial.cloth.start;
  trial.cloth = make_cloth(trial.scene);
  trial.cloth.start = start;
  return trial;
}

// Its moment relaxes as e^(-t/tau), in one step of any length as in many.
TEST(LongStep, RelaxesAHeldSheetAsTheClosedFormSays) {
  constexpr double kTau = 30, kRounding = 1e-9;
  const Trial trial = held_in_waves("quasi-static", kTau);
  const auto simulation = trial.after(1);
  const double begun = simulation->time();
  const std::vector<double> first = simulation->moment();
  simulation->advance_by(7);
  EXPECT_NEAR(simulation->time(), begun + 7, kRounding);
  const std::vector<double> then = simulation->moment();
  simulation->advance_by(100 * kTau);
  const std::vector<double> last = simulation->moment();
  double branch = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_NEAR(then[i] - last[i], (first[i] - last[i]) * std::exp(-7 / kTau),
                kRounding * std::abs(first[i]));
    branch = std::max(branch, std::abs(first[i] - last[i]));
  }
  EXPECT_GT(branch, 0);
}

TEST(LongStep, IsRefusedWhereStepsAreOfOneLength) {
  for (const char* integrator : {"semi-implicit", "explicit", "implicit", "tr-bdf2"})
    EXPECT_THROW(held_in_waves(integrator, 1).after(1)->advance_by(1), Error) << integrator;
}

// A state that is saved in between goes on at the same time.
TEST(LongStep, IsRememberedByAStateThatIsSaved) {
  const Trial trial = held_in_waves("quasi-static", 1);
  const auto simulation = trial.after(1), other = trial.simulation();
  simulation->advance_by(2.5);
  other->load(simulation->save());
  EXPECT_EQ(other->time(), simulation->time());
  EXPECT_EQ(other->moment(), simulation->moment());
}

}  // namespace
}  // namespace hysteron
