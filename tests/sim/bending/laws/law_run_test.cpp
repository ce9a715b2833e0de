// One law is driven through a list of curvatures: names, parameters, rows.
#include "sim/bending/laws/law_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/base/error.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/recovery.h"
#include "sim/bending/laws/unused_parameters.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

using test::says;
std::vector<LawRow> rows(const std::vector<double>& curvatures) {
  std::vector<LawRow> result;
  for (double k : curvatures) result.push_back({k});
  return result;
}

std::string refusal(const LawRequest& request) {
  return test::refusal([&] { run_law(request, rows({1.0})); });
}

TEST(LawRun, KnowsEveryNameOnce) {
  std::set<std::string> names;
  for (const LawEntry& law : law_catalogue()) {
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    EXPECT_FALSE(law.description.empty());
    EXPECT_EQ(run_law({law.name, kCotton, {}}, rows({1.0, 2.0})).moment.size(), 2u);
  }
  EXPECT_GE(names.size(), 15u);
}

TEST(LawRun, RefusesWhatIsUnknownOrOutOfRangeInOneLine) {
  EXPECT_TRUE(says(refusal({"dhal", kCotton, {}}), "unknown law 'dhal'"));
  EXPECT_TRUE(says(refusal({"wong", kCotton, {{"stops", "8"}}}), "unknown parameter stops = 8"));
  EXPECT_TRUE(says(refusal({"prandtl", kCotton, {{"stack", "7"}}}), "stack = 7 must be"));
  EXPECT_TRUE(says(refusal({"prandtl", kCotton, {{"memory", "tape"}}}), "memory = tape"));
  EXPECT_TRUE(says(refusal({"wong", kCotton, {{"recovery", "1"}}}), "recovery = 1"));
  EXPECT_TRUE(says(refusal({"kim", kCotton, {{"tau", "0"}}}), "tau = 0 must be > 0 s"));
  EXPECT_TRUE(says(refusal({"narain", {1e-5, 1e-5, 0}, {}}), "yield must be given"));
  EXPECT_TRUE(says(refusal({"spring", kCotton, {{"height", "0.2"}}}), "height = 0.2 m"));
  EXPECT_TRUE(says(refusal({"spring", kCotton, {{"height", "1e-5"}}}), "crush the triangles"));
  EXPECT_TRUE(says(refusal({"wong", kCotton, {{"fatigue.m-inf", "1"}}}),
                   "fatigue.m-inf = 1 N must be in [0, 0.000608]"));
  EXPECT_TRUE(says(refusal({"dahl", kCotton, {{"fatigue.dc", "1"}}}), "allowed: none"));
}

TEST(LawRun, PrandtlMeansAStackOfSixtyFourAndAccumulatesWhatIsLost) {
  const auto turns = random_turns(100, 2 * kCotton.k0, 71);
  const LawRun run = run_law({"prandtl", kCotton, {}}, rows(turns));
  Driven cloth(PrandtlStack<double, 64>::make(kCotton));
  for (size_t i = 0; i < turns.size(); ++i) {
    const double slope = cloth.law.tangent(Vec<double, 1>(turns[i]), cloth.history)(0, 0);
    ASSERT_EQ(run.moment[i], cloth.moment(turns[i]));
    ASSERT_EQ(run.tangent[i], slope);
    ASSERT_EQ(run.stored[i], cloth.last.stored);
    ASSERT_EQ(run.dissipated[i], cloth.dissipated);
  }
}

TEST(LawRun, TheFirstRowIsTheFirstCurvatureVisitedFromRest) {
  const LawRun run = run_law({"wong", kCotton, {}}, rows({kCotton.k0}));
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(run.moment[0], kCotton.elastic_limit_moment(), kRounding);
  EXPECT_NEAR(run.dissipated[0], 2. / 3 * kCotton.friction_moment() * kCotton.k0,
              kRounding);  // work of friction
}

TEST(LawRun, ParametersChooseTheMemoryAndTheRecovery) {
  const auto path = rows({0.5 * kCotton.k0, 0.0});
  const double m0 = kCotton.friction_moment();
  const LawRun stack = run_law({"prandtl", kCotton, {}}, path);
  const LawRun stops = run_law({"prandtl", kCotton, {{"memory", "stops"}, {"stops", "32"}}}, path);
  EXPECT_NE(stack.moment[1], stops.moment[1]);
  EXPECT_NEAR(stack.moment[1], stops.moment[1], 4 * m0 / (4 * 32 * 32));
  constexpr double kRounding = 1e-16;
  EXPECT_NEAR(run_law({"wong", kCotton, {{"recovery", "reversible"}}}, path).moment[1], 0, kRounding);
  EXPECT_LT(run_law({"wong", kCotton, {}}, path).moment[1], -0.1 * m0);
}

// `chapman` depends on time by its fabric's branches alone.
TEST(LawRun, TakesTimeWhereALawCreepsAgesOrRelaxes) {
  VirginCurve relaxing = kCotton;
  relaxing.parts.branches = {{1.0}, {1e-5}};
  std::vector<std::string> timed;
  for (const LawEntry& law : law_catalogue())
    if (takes_time({law.name, relaxing, {}})) timed.push_back(law.name);
  EXPECT_EQ(timed, (std::vector<std::string>{"terzopoulos", "kim", "gong", "chapman"}));
  EXPECT_FALSE(takes_time({"chapman", kCotton, {}}));
  relaxing.parts.set = {50, 1e-5};
  EXPECT_TRUE(takes_time({"chapman", relaxing, {}})) << "branches within a set";
  for (const std::string& name : timed) {
    const std::vector<LawRow> quick = {{150, 1e-3}, {150, 1e-3}}, slow = {{150, 1}, {150, 100}};
    const LawRequest law = {name, relaxing, {}};
    EXPECT_NE(run_law(law, quick).moment[1], run_law(law, slow).moment[1]) << name;
  }
}

// A law alone remembers by a stack, of which `stops` is none; `chapman` has stops alone.
TEST(LawRun, TakesTheStopsThatALawWithoutAStackIsGiven) {
  const std::vector<LawRow> rows = {{0.3 * kCotton.k0}};
  EXPECT_NE(run_law({"chapman", kCotton, {{"stops", "4"}}}, rows).moment,
            run_law({"chapman", kCotton, {{"stops", "32"}}}, rows).moment);
  EXPECT_EQ(run_law({"chapman", kCotton, {}}, rows).moment,
            run_law({"chapman", kCotton, {{"stops", "32"}}}, rows).moment);
}

TEST(LawParameters, ThatChangeNothingAreSaid) {
  VirginCurve own_stops = kCotton;
  own_stops.parts.stops = parabola_stops(kCotton.b1 - kCotton.b2, kCotton.k0, 6);
  const auto said = [](const std::string& law, const VirginCurve& curve, const LawParameters& given,
                       LawUse use) {
    const std::vector<std::string> texts = unused_parameter_warnings(law, curve, given, use, "linen");
    return texts.empty() ? "" : texts[0];
  };
  EXPECT_TRUE(says(said("prandtl", own_stops, {{"stops", "8"}}, LawUse::cloth),
                   "param stops is not used: the 6 stops of linen are the law's memory"));
  EXPECT_TRUE(says(said("chapman", own_stops, {{"stops", "8"}}, LawUse::alone), "the 6 stops of linen"));
  EXPECT_TRUE(says(said("prandtl", kCotton, {{"stops", "8"}}, LawUse::alone), "by a stack"));
  EXPECT_TRUE(says(said("prandtl", kCotton, {{"stack", "8"}}, LawUse::cloth), "remembers by stops"));
  EXPECT_TRUE(
      says(said("wong", kCotton, {{"fatigue.m-inf", "0"}}, LawUse::cloth), "without param fatigue.dc"));
  EXPECT_EQ(said("prandtl", kCotton, {{"stops", "8"}}, LawUse::cloth), "");
  EXPECT_EQ(said("prandtl", kCotton, {{"stops", "8"}, {"memory", "stops"}}, LawUse::alone), "");
  EXPECT_EQ(said("prandtl", kCotton, {{"stack", "8"}}, LawUse::alone), "");
  EXPECT_EQ(said("chapman", kCotton, {{"stops", "8"}}, LawUse::alone), "");
  EXPECT_EQ(said("wong", kCotton, {{"fatigue.m-inf", "0"}, {"fatigue.dc", "1"}}, LawUse::cloth), "");
}

TEST(LawParameters, PartsOfAFabricThatALawDoesNotTakeAreSaid) {
  VirginCurve curve = kCotton;
  curve.parts.stops = {{5, 50}, {1e-5, 2e-6}};
  curve.parts.weft_stops = {{6, 40}, {8e-6, 1e-6}};
  curve.parts.branches = {{1.0}, {1e-6}};
  curve.parts.set = {400, 5e-6};
  const auto count = [&](const std::string& law, LawUse use) {
    return unused_parameter_warnings(law, curve, {}, use, "linen").size();
  };
  EXPECT_EQ(count("linear", LawUse::cloth), 3u);
  EXPECT_EQ(count("linear", LawUse::alone), 2u) << "a law alone bends along warp";
  EXPECT_EQ(count("chapman", LawUse::cloth), 0u);
  const auto said = unused_parameter_warnings("prandtl", curve, {}, LawUse::cloth, "linen");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0], "fabric.bending.branches of linen changes nothing under law prandtl: chapman takes it");
  EXPECT_EQ(unused_parameter_warnings("wong", kCotton, {}, LawUse::cloth, "linen").size(), 0u);
}

TEST(LawWalk, TakesTheStepsOfARunAndItsCopiesGoOnByThemselves) {
  const auto path = rows({kCotton.k0, 3 * kCotton.k0, -0.5 * kCotton.k0, kCotton.k0, 0.0});
  for (const LawRequest& request :
       {LawRequest{"wong", kCotton, {}}, LawRequest{"prandtl", kCotton, {{"fatigue.dc", "0.1"}}}}) {
    const LawRun run = run_law(request, path);
    LawWalk walk(request);
    for (std::size_t i = 0; i < path.size(); ++i) {
      LawWalk copy = walk;
      copy.to({-5 * kCotton.k0});
      const LawPoint point = walk.to(path[i]);
      ASSERT_EQ(point.moment, run.moment[i]);
      ASSERT_EQ(point.stored, run.stored[i]);
      ASSERT_EQ(point.dissipated, run.dissipated[i]);
    }
    EXPECT_EQ(walk.residual(), residual_after(request, path));
  }
}

TEST(LawWalk, KnowsWhatFatigueHasLeft) {
  const double m0 = kCotton.friction_moment();
  LawWalk walk({"prandtl", kCotton, {{"fatigue.dc", "0.1"}}}), sound({"prandtl", kCotton, {}});
  EXPECT_EQ(walk.friction_moment(), m0);
  EXPECT_TRUE(std::isnan(sound.friction_moment()));
  for (const LawRow& row : rows({3 * kCotton.k0, 0.5 * kCotton.k0, 3 * kCotton.k0, 0.5 * kCotton.k0})) {
    walk.to(row);
    sound.to(row);
  }
  EXPECT_LT(walk.friction_moment(), m0);
  EXPECT_GT(walk.permanent_set(), 0);
  EXPECT_LE(walk.permanent_set(), (m0 - walk.friction_moment()) / kCotton.b2);
  EXPECT_EQ(sound.permanent_set(), 0);
}

}  // namespace
}  // namespace hysteron::testing
