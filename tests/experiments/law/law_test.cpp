// `hysteron law` from file to file.
#include "experiments/law/law.h"

#include <cmath>
#include <fstream>

#include "sim/base/csv.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

class LawCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    options_ = {"wong", {4e-5, 1e-5, 50}, {}, folder_.file("k.csv"), folder_.file("m.csv")};
    write("curvature [1/m],time [s]\n50,0\n100,1\n");
  }

  void write(const std::string& text) { std::ofstream(options_.in) << text; }
  std::string refusal() {
    const std::string message = test::refusal([&] { run_law_command(options_); });
    EXPECT_FALSE(std::filesystem::exists(options_.out));
    return message;
  }
  const Folder folder_;
  LawOptions options_;
};

TEST_F(LawCommand, WritesMomentTangentAndEnergiesForEveryRow) {
  EXPECT_EQ(run_law_command(options_), 0);
  const Table out = read_csv(
      options_.out, {"curvature [1/m]", "moment [N]", "tangent [N m]", "stored [J/m2]", "dissipated [J/m2]"},
      {}, "law");
  const double m0 = 3e-5 * 50 / 2, b2 = 1e-5;
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(out.number(0, "moment [N]"), m0 + b2 * 50, kRounding);
  EXPECT_NEAR(out.number(1, "tangent [N m]"), b2, kRounding);
  EXPECT_NEAR(out.number(1, "stored [J/m2]"), b2 * 100 * 100 / 2, kRounding);
  EXPECT_NEAR(out.number(1, "dissipated [J/m2]"), m0 * (100 - 50. / 3), kRounding);
}

TEST_F(LawCommand, RefusesTheChaptersSignOfTheRigidities) {
  options_.curve = {1e-5, 2e-5, 50};
  EXPECT_TRUE(has(refusal(), "--b1 = 1e-05 N m must be finite and >= b2 = 2e-05 N m"));
}

TEST_F(LawCommand, RefusesWhatItCannotUnderstand) {
  options_.parameters = {{"recovery", "elastic"}};
  EXPECT_TRUE(has(refusal(), "recovery = elastic must be masing or reversible"));
  options_.parameters = {};
  write("curvature [1/m],time [s]\n50,1\n100,0\n");
  EXPECT_TRUE(has(refusal(), "k.csv:3: time = 0 s must be >= 1 s"));
  write("curvature [1/m],edit\n50,2\n");
  EXPECT_TRUE(has(refusal(), "k.csv:2: edit = 2 must be 0 or 1"));
}

TEST_F(LawCommand, RefusesWhatNoNumberCanHold) {
  write("curvature [1/m]\n50\n1e300\n");
  EXPECT_TRUE(has(refusal(), "k.csv:3: curvature = 1e+300 1/m must be within +-1e+06 1/m"));
  options_.law = "linear";
  options_.curve = {1e306, 1e306, 50};
  write("curvature [1/m]\n1\n\n-1000\n");
  EXPECT_TRUE(has(refusal(), "k.csv:4: at curvature = -1000 1/m the law's moment [N] is no finite number"));
}

TEST_F(LawCommand, GivesTimeAndCommandsToTheLawsThatTakeThem) {
  const auto moments = [&] {
    EXPECT_EQ(run_law_command(options_), 0);
    return read_csv(options_.out, {"moment [N]"}, {}, "law").numbers("moment [N]");
  };
  options_.law = "terzopoulos";
  write("curvature [1/m],time [s]\n200,0\n200,1\n200,1001\n");
  const double m0 = 3e-5 * 50 / 2, excess = 1e-5 * 200 - m0;
  constexpr double kRounding = 1e-15;
  const std::vector<double> creep = moments();
  EXPECT_NEAR(creep[0], m0 + excess, kRounding);  // no time has passed
  EXPECT_NEAR(creep[1], m0 + excess * std::exp(-1), kRounding);
  EXPECT_NEAR(creep[2], m0, kRounding);
  options_.law = "grinspun-edit";
  write("curvature [1/m],edit\n200,1\n150,0\n");
  EXPECT_NEAR(moments()[0], 0, kRounding);
  EXPECT_NEAR(moments()[1], -50e-5, kRounding);
}

}  // namespace
}  // namespace hysteron::experiments
