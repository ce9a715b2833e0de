// These tests check fronts and orders on made-up findings, and the problems' own answers at small size.
#include <algorithm>
#include <cmath>

#include "experiments/accuracy/accuracy.h"
#include "sim/base/csv.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Solved made_up(int triangles, double error, double seconds, const std::string& law = "linear") {
  Solved solved;
  solved.setting.triangles = triangles;
  solved.setting.law = law;
  solved.found.triangles = triangles;
  solved.found.error = error;
  solved.found.seconds = seconds;
  return solved;
}

Solution made_up_solution() {
  Solution solution;
  solution.solved = {made_up(100, 0.04, 1), made_up(400, 0.01, 4), made_up(1600, 0.0025, 16),
                     made_up(900, 0.02, 9), made_up(100, 0.001, 0.5, "pabst")};
  for (const Solved& s : solution.solved) solution.problem.settings.push_back(s.setting);
  return solution;
}

TEST(AccuracyFront, HoldsWhatNothingElseBeatsOnTheSameQuestion) {
  EXPECT_EQ(pareto_front(made_up_solution()), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(AccuracyFront, NamesTheCheapestWithinAnError) {
  const Solution solution = made_up_solution();
  EXPECT_EQ(cheapest(solution, 0.1), 0u);
  EXPECT_EQ(cheapest(solution, 0.01), 1u);
  EXPECT_EQ(cheapest(solution, 0.003), 2u);
  EXPECT_FALSE(cheapest(solution, 0.001)) << "only another law is as good";
}

TEST(AccuracyFront, LeavesOutWhatFailed) {
  Solution solution = made_up_solution();
  solution.solved[0].found.failed = "no equilibrium";
  EXPECT_EQ(pareto_front(solution).front(), 1u);
}

TEST(ObservedOrders, AreThoseOfTheErrors) {
  Solution solution = made_up_solution();
  solution.solved.erase(solution.solved.begin() + 3);
  const auto orders = observed_orders(solution);
  ASSERT_EQ(orders.size(), 2u);
  for (const Order& order : orders) EXPECT_NEAR(order.order, 2, 1e-12);
}

const Effort kQuick{true, DeviceChoice::cpu};

// The crease has the chapter's law, element, force and order of stages, beside the same splitting of the
// default model.
TEST(Crease, HasTheChaptersMethodAsPrintedUnderItsOwnName) {
  Solution solution{crease_problem(kQuick), {}};
  std::vector<std::string> names;
  for (const MethodSetting& s : solution.problem.settings) {
    names.push_back(describe(solution, s));
    if (s.force != ForceConvention::chapter) continue;
    EXPECT_EQ(s.law, "wong");
    EXPECT_EQ(s.element, BendingElement::hinge);
    EXPECT_EQ(s.implicit_every, ImplicitEvery::step);
    EXPECT_FALSE(solution.comparable(s)) << "it answers another model's question";
  }
  for (const char* name : {"the chapter's splitting, 60 triangles, 1/60 s",
                           "the chapter's method, hinge, wong, 60 triangles, 1/60 s",
                           "the chapter's splitting, hinge, wong, 60 triangles, 1/60 s"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

// Second order: a quarter of the triangles has four times the error.
TEST(Sag, ConvergesWithTheMesh) {
  const Problem problem = sag_problem(kQuick);
  MethodSetting setting = problem.settings.front();
  double before = 0;
  for (const int triangles : {32, 128, 512}) {
    setting.triangles = triangles;
    const double error = problem.solve(setting).error;
    if (before > 0) {
      EXPECT_LT(error, 0.4 * before) << triangles;
    }
    before = error;
  }
}

TEST(Sag, OfHingesOnACutGridDropsTooFar) {
  const Problem problem = sag_problem(kQuick);
  MethodSetting setting = problem.settings.front();
  setting.element = BendingElement::hinge;
  setting.load = 1;
  const Found found = problem.solve(setting);
  EXPECT_NEAR(found.value / found.reference, 1.22, 0.03) << enum_name(setting.mesh);
}

// Observed orders of the integrators on a smooth motion.
double order_in_time(const std::string& integrator, double step) {
  const Problem problem = swing_problem(kQuick);
  MethodSetting setting = problem.settings.front();
  setting.integrator = value_named<Integrator>(integrator);
  setting.step = step;
  const double coarse = problem.solve(setting).error;
  setting.step = step / 2;
  return std::log2(coarse / problem.solve(setting).error);
}

TEST(Swing, Bdf2IsOfSecondOrder) { EXPECT_GT(order_in_time("bdf2", 1.0 / 480), 1.9); }
TEST(Swing, ImplicitIsOfFirstOrder) { EXPECT_NEAR(order_in_time("implicit", 1.0 / 960), 0.95, 0.1); }
TEST(Swing, SemiImplicitIsOfFirstOrder) { EXPECT_NEAR(order_in_time("semi-implicit", 1.0 / 30720), 1, 0.1); }

TEST(AccuracyCommand, WritesTablesOrdersAndTheCheapest) {
  const Folder folder;
  const auto out = folder.path() / "a";
  EXPECT_EQ(run_into(out, "accuracy", {{"problem", "bend"}, {"quick", true}}), 0);
  const std::string table = file_content(out / "table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'),
            1 + static_cast<long>(bend_problem(kQuick).settings.size()));
  for (const char* file : {"cheapest.csv", "orders.csv"}) {
    const Table found = read_table(out / file);
    ASSERT_FALSE(found.rows.empty()) << file;
    for (std::size_t row = 0; row < found.rows.size(); ++row)
      EXPECT_EQ(found.word(row, "problem"), "bend") << file;
  }
}

TEST(AccuracyCommand, SolvesNoProblemTwice) {
  const auto said = [](const char* problems) {
    return test::refusal([&] { run_into("never", "accuracy", {{"problem", problems}}); });
  };
  EXPECT_TRUE(says(said("bend,sag,bend"), "problem = bend,sag,bend names bend twice (--problem)"));
  EXPECT_TRUE(says(said("bend,all"), "problem = all must be bend | "));
}

}  // namespace
}  // namespace hysteron::experiments
