// These tests run `hysteron law` from file to file.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "experiments/workbench/app/experiment.h"
#include "sim/base/csv.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

class LawCommand : public ::testing::Test {
 protected:
  void SetUp() override { write("curvature [1/m],time [s]\n50,0\n100,1\n"); }

  void write(const std::string& text) { std::ofstream(in_) << text; }
  // The flags replace those of the usual law, or are added to them.
  int run(std::vector<Flag> flags = {}) {
    std::vector<Flag> all = {{"law", "wong"}, {"b1", 4e-5}, {"b2", 1e-5}, {"k0", 50}};
    all.insert(all.end(), {{"in", in_}, {"out", out_}});
    all.insert(all.end(), flags.begin(), flags.end());
    return experiment_named("law").run({"law", "hysteron law", all, {}});
  }
  // Returns the text on stderr of a request that is answered.
  std::string warnings(const std::vector<Flag>& flags = {}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(run(flags), 0);
    return testing::internal::GetCapturedStderr();
  }
  std::string refusal(const std::vector<Flag>& flags = {}) {
    const std::string message = test::refusal([&] { run(flags); });
    EXPECT_FALSE(std::filesystem::exists(out_));
    return message;
  }
  const Folder folder_;
  const std::string in_ = folder_.file("k.csv"), out_ = folder_.file("m.csv");
};

TEST_F(LawCommand, WritesMomentTangentAndEnergiesForEveryRow) {
  EXPECT_EQ(run(), 0);
  const Table out =
      read_csv(out_, {"curvature [1/m]", "moment [N]", "tangent [N m]", "stored [J/m2]", "dissipated [J/m2]"},
               {}, "law");
  const double m0 = 3e-5 * 50 / 2, b2 = 1e-5;
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(out.number(0, "moment [N]"), m0 + b2 * 50, kRounding);
  EXPECT_NEAR(out.number(1, "tangent [N m]"), b2, kRounding);
  EXPECT_NEAR(out.number(1, "stored [J/m2]"), b2 * 100 * 100 / 2, kRounding);
  EXPECT_NEAR(out.number(1, "dissipated [J/m2]"), m0 * (100 - 50. / 3), kRounding);
}

TEST_F(LawCommand, RefusesTheChaptersSignOfTheRigidities) {
  EXPECT_TRUE(
      says(refusal({{"b1", 1e-5}, {"b2", 2e-5}}), "--b1 = 1e-05 N m must be finite and >= b2 = 2e-05 N m"));
}

TEST_F(LawCommand, RefusesWhatItCannotUnderstand) {
  EXPECT_TRUE(
      says(refusal({{"param", "recovery=elastic"}}), "recovery = elastic must be masing or reversible"));
  write("curvature [1/m],time [s]\n50,1\n100,0\n");
  EXPECT_TRUE(says(refusal(), "k.csv:3: time = 0 s must be >= 1 s"));
  write("curvature [1/m],edit\n50,2\n");
  EXPECT_TRUE(says(refusal(), "k.csv:2: edit = 2 must be 0 or 1"));
}

TEST_F(LawCommand, RefusesWhatNoFabricHas) {
  write("curvature [1/m]\n50\n1e300\n");
  EXPECT_TRUE(says(refusal(), "k.csv:3: curvature = 1e+300 1/m must be within +-1e+06 1/m"));
  write("curvature [1/m]\n1\n");
  EXPECT_TRUE(says(refusal({{"b1", 20}}), "b1 = 20 N m must be in [0, 10] N m, as fabrics can be"));
}

TEST_F(LawCommand, WarnsOfUnusualNumbersWithTheUnitThatWasProbablyMeant) {
  EXPECT_EQ(warnings(), "");
  // 0.3 gf cm^2/cm times 9.80665e-5 N m.
  EXPECT_TRUE(says(warnings({{"b1", 0.3}}),
                   "warning: b1 = 0.3 N m (--b1) is unusual: fabrics have 1e-08 to 0.001 N m; gf cm^2/cm "
                   "given? Then it is 2.94e-05 N m"));
}

TEST_F(LawCommand, WarnsOfParametersThatChangeNothing) {
  EXPECT_TRUE(says(warnings({{"law", "prandtl"}, {"param", "stops=8"}}), "param stops is not used"));
  EXPECT_EQ(warnings({{"law", "prandtl"}, {"param", "stack=8"}}), "");
}

// Gong's friction slips at a limit that grows with the time held, and the second row releases it.
TEST_F(LawCommand, TakesTimeFromTheColumnTAndSaysWhereThereIsNone) {
  const std::string rows = "\n100,0\n100,100\n60,101\n";
  const auto moment = [&](const std::string& head) {
    write(head + rows);
    EXPECT_FALSE(says(warnings({{"law", "gong"}}), "has no column time"));
    return read_csv(out_, {"moment [N]"}, {}, "law").numbers("moment [N]").back();
  };
  EXPECT_EQ(moment("curvature [1/m],t [s]"), moment("curvature [1/m],time [s]"));
  write("curvature [1/m]\n100\n100\n60\n");
  EXPECT_TRUE(says(warnings({{"law", "gong"}}),
                   "has no column time [s], and law gong takes time: every row is taken as a step of 1 s"));
  EXPECT_EQ(warnings({{"law", "wong"}}), "");
  std::filesystem::remove(out_);
  write("curvature [1/m],time [s]\n100,5\n100,5\n60,5\n");
  EXPECT_TRUE(says(refusal({{"law", "gong"}}), "k.csv:4: time = 5 s must rise from the first row"));
}

TEST_F(LawCommand, GivesTimeAndCommandsToTheLawsThatTakeThem) {
  const auto moments = [&](const std::string& law) {
    EXPECT_EQ(run({{"law", law}}), 0);
    return read_csv(out_, {"moment [N]"}, {}, "law").numbers("moment [N]");
  };
  write("curvature [1/m],time [s]\n200,0\n200,1\n200,1001\n");
  const double m0 = 3e-5 * 50 / 2, excess = 1e-5 * 200 - m0;
  constexpr double kRounding = 1e-15;
  const std::vector<double> creep = moments("terzopoulos");
  EXPECT_NEAR(creep[0], m0 + excess, kRounding);  // no time has passed
  EXPECT_NEAR(creep[1], m0 + excess * std::exp(-1), kRounding);
  EXPECT_NEAR(creep[2], m0, kRounding);
  write("curvature [1/m],edit\n200,1\n150,0\n");
  EXPECT_NEAR(moments("grinspun-edit")[0], 0, kRounding);
  EXPECT_NEAR(moments("grinspun-edit")[1], -50e-5, kRounding);
}

// Returns legs of so many rows each, to 100 1/m and to -100 1/m.
std::string way_there_and_back(int rows) {
  std::string text = "curvature [1/m],time [s]\n";
  for (int i = 1; i <= rows; ++i) text += fmt::format("{:.12g},{:.12g}\n", 100. * i / rows, 1. * i / rows);
  for (int i = 1; i <= rows; ++i)
    text += fmt::format("{:.12g},{:.12g}\n", 100 - 200. * i / rows, 1 + 1. * i / rows);
  return text;
}

constexpr const char* kByLength = "rows are taken as whole steps: with each cut into eight";

// Narain's friction moves by a share of what each step brings, kim's and terzopoulos' plastic curvature too.
TEST_F(LawCommand, WarnsWhereTheLengthOfTheStepsDecides) {
  write(way_there_and_back(1));
  for (const char* law : {"narain", "kim", "terzopoulos"})
    EXPECT_TRUE(says(warnings({{"law", law}}), kByLength, "give more rows", law));
  EXPECT_TRUE(says(warnings({{"law", "prandtl"}, {"param", "fatigue.dc=1e-3"}}), kByLength));
  write(way_there_and_back(1000));
  for (const char* law : {"kim", "terzopoulos"}) EXPECT_EQ(warnings({{"law", law}}), "") << law;
  EXPECT_EQ(warnings({{"law", "prandtl"}, {"param", "fatigue.dc=1e-3"}}), "");
}

TEST_F(LawCommand, NeverWarnsOfTheLengthOfTheStepsOfALawThatDoesNotSeeThem) {
  const std::string sees_steps[] = {"narain", "kim", "terzopoulos", "gong"};
  for (const char* rows : {"100,0\n-100,0\n", "80,0\n-3,0\n50,1\n-120,0\n7,0\n", "0,0\n0,0\n"}) {
    write(std::string("curvature [1/m],edit\n") + rows);
    for (const std::string& law : law_names()) {
      if (std::count(std::begin(sees_steps), std::end(sees_steps), law)) continue;
      EXPECT_EQ(warnings({{"law", law}}), "") << law;
    }
  }
}

}  // namespace
}  // namespace hysteron::experiments
