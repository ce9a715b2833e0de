// A column that is tuned to another.
#include "experiments/compare/tuning.h"

#include <cmath>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

Tuning tuning() { return parsed_tuning("fabric.damping=1e-5:1e-1", "viscous_J=bending_friction_J"); }

TEST(Tuning, IsReadFromItsTwoOptions) {
  const Tuning two = tuning(), one = parsed_tuning("step=1e-3:2e-3", "tip_m");
  EXPECT_EQ(two.key, "fabric.damping");
  EXPECT_EQ(two.low, "1e-5");
  EXPECT_EQ(two.high, "1e-1");
  EXPECT_EQ(two.metric, "viscous_J");
  EXPECT_EQ(two.target, "bending_friction_J");
  EXPECT_EQ(one.metric, "tip_m");
  EXPECT_EQ(one.target, "tip_m");
}

// Nine halvings of four decades leave 4/2^9 decades.
TEST(Tuning, ClosesInOnTheRootOfARisingAndAFallingMetric) {
  const double root = 4.2e-3, width = std::pow(10.0, 4.0 / 512);
  for (const double sign : {1.0, -1.0}) {
    int tries = 0;
    const std::string number = tuned(tuning(), [&](const std::string& tried) {
      ++tries;
      return sign * (std::stod(tried) - root);
    });
    EXPECT_EQ(tries, 2 + kBisections);
    EXPECT_LT(std::abs(std::log(std::stod(number) / root)), std::log(width) * 1.01) << number;
    EXPECT_LE(number.size(), std::string("0.001234").size()) << "four significant digits";
  }
}

TEST(Tuning, TriesTheMiddlesOfTheLogarithmToFourDigits) {
  std::vector<std::string> tried;
  tuned(tuning(), [&](const std::string& number) {
    tried.push_back(number);
    return std::stod(number) - 5e-3;
  });
  ASSERT_GE(tried.size(), 6u);
  EXPECT_EQ(std::vector<std::string>(tried.begin(), tried.begin() + 6),
            (std::vector<std::string>{"1e-5", "1e-1", "0.001", "0.01", "0.003162", "0.005623"}));
}

TEST(Tuning, RefusesABracketWithoutARoot) {
  EXPECT_EQ(test::refusal([] { tuned(tuning(), [](const std::string&) { return 1.0; }); }),
            "viscous_J is not below the second column's bending_friction_J at both ends of fabric.damping = "
            "1e-5:1e-1: widen the bracket (--compare.tune)");
}

const std::string kSmallStrip =
    " --triangles 16 --seconds 0.1 --fps 30 --device cpu --no-images --quiet --compare.match fabric";

// Both columns are the same strip but for its viscosity, so that the number found is the second column's.
TEST(Compare, TunesItsFirstColumnToItsSecond) {
  const FinishedRun run(
      "compare swing --laws linear,linear+fabric.damping=2e-3 --compare.tune fabric.damping=1e-3:4e-3 "
      "--compare.tune-metric viscous_J" +
      kSmallStrip);
  const std::string line = run.outcome.out.substr(0, run.outcome.out.find('\n'));
  ASSERT_EQ(line.find("fabric.damping="), 0u) << run.outcome.out;
  const Json scene = run.manifest()["scene"];
  const double found = scene["tuned"]["value"].get<double>();
  const double bracket = std::log(4.0) / 512, four_digits = 5e-4;  // relative, after nine halvings
  EXPECT_NEAR(found / 2e-3, 1, bracket + four_digits);
  EXPECT_EQ(scene["columns"][0]["name"], "linear+" + line);
  EXPECT_TRUE(fs::exists(run.out / ("linear+" + line) / "manifest.json"));
}

// The metric of both is equal at the upper end of the bracket, which is the second column's own number.
TEST(Compare, TunesOntoAnotherColumnsNumberBesideIt) {
  const FinishedRun run(
      "compare swing --laws linear,linear+fabric.damping=0.002 --compare.tune fabric.damping=0.001:0.002 "
      "--compare.tune-metric viscous_J --compare.to linear" +
      kSmallStrip);
  const Json columns = run.manifest()["scene"]["columns"];
  EXPECT_EQ(columns[0]["name"], "linear+fabric.damping=0.002-2");
  EXPECT_EQ(columns[1]["name"], "linear+fabric.damping=0.002");
}

TEST(Compare, RefusesToTuneWhatItCannot) {
  const Folder folder;
  const auto refusal = [&](const std::string& options) {
    return refused("compare swing " + options + out_flag(folder.path() / "out") + kSmallStrip);
  };
  const std::string columns = "--laws linear,prandtl ",
                    metric = " --compare.tune-metric viscous_J=bending_friction_J";
  EXPECT_EQ(refusal(columns + "--compare.tune fabric.damping" + metric),
            "hysteron compare: compare.tune = fabric.damping must be KEY=LOW:HIGH, such as "
            "fabric.damping=1e-5:1e-1 (--compare.tune)\n");
  EXPECT_EQ(refusal(columns + "--compare.tune fabric.damping=1e-1:1e-5" + metric),
            "hysteron compare: compare.tune = fabric.damping=1e-1:1e-5 must be a bracket with 0 < LOW < HIGH "
            "(--compare.tune)\n");
  EXPECT_EQ(refusal(columns + "--compare.tune fabric.damping=1e-5:1e-1"),
            "hysteron compare: compare.tune needs what is to be equal: --compare.tune-metric METRIC, or "
            "METRIC=METRIC of the second column\n");
  EXPECT_EQ(
      refusal("--laws linear --compare.tune fabric.damping=1e-5:1e-1" + metric),
      "hysteron compare: compare.tune needs two columns, the one to tune and its target (--compare.tune)\n");
  EXPECT_TRUE(says(refusal(columns + "--compare.tune fabric.dampin=1e-5:1e-1" + metric), "fabric.damping"));
  EXPECT_TRUE(says(refusal(columns + metric), "compare.tune-metric needs --compare.tune"));
  EXPECT_TRUE(says(refusal(columns + "--compare.tune fabric.damping=1e-5:1e-1 --compare.tune-metric heat_J"),
                   "has no metric heat_J that is a number (--compare.tune-metric)"));
}

}  // namespace
}  // namespace hysteron::experiments
