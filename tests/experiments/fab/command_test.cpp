// These tests run `hysteron fab` from flags to its folder.
#include <fstream>

#include "sim/base/csv.h"
#include "sim/reference/fab_loops.h"
#include "sim/scene/assets.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

class FabCommand : public testing::Test {
 protected:
  int fab(std::vector<Flag> flags, const std::string& out = "out") {
    for (const auto& [key, value] : {std::pair{"quick", true}, {"quiet", true}, {"json", true}})
      flags.push_back({key, value});
    flags.push_back({"out", (folder_.path() / out).string()});
    testing::internal::CaptureStdout();
    struct Captured {  // also where the run is refused
      ~Captured() { testing::internal::GetCapturedStdout(); }
    } const captured;
    return experiment_named("fab").run({"fab", "hysteron fab", flags, {}});
  }
  Json metrics(const std::string& out = "out") const { return metrics_of(folder_.path() / out); }
  Folder folder_;
};

TEST_F(FabCommand, WithoutDataStatesAreasThatGrowWithTheCompression) {
  ASSERT_EQ(fab({{"fabric", "cotton-broad"}, {"fab.compressions", "0.003,0.005,0.007"}}), 0);
  const auto m = metrics();
  EXPECT_GT(m.at("area_cycle1_J_per_m"), 0);
  EXPECT_GT(m.at("area_cycle2_J_per_m"), m.at("area_cycle1_J_per_m"));
  EXPECT_GT(m.at("area_cycle3_J_per_m"), m.at("area_cycle2_J_per_m"));
  EXPECT_LT(m.at("energy_imbalance_percent"), 2);
  for (const char* name : {"plot_fab.png", "plot_shapes.png", "fab.csv", "report.html"})
    EXPECT_TRUE(fs::exists(folder_.path() / "out" / name)) << name;
}

// Such a fabric gives back what was done on it, and loses nothing: the balance is over what was done.
TEST_F(FabCommand, OfAFabricWithoutFrictionClosesItsBalance) {
  const std::string file = (folder_.path() / "elastic.toml").string();
  std::ofstream(file) << "[parameters]\ndensity = 0.12\nthickness = 4e-4\nb1 = 1e-5\nb2 = 1e-5\nk0 = 0\n";
  ASSERT_EQ(fab({{"fabric", file}, {"no-images", true}}), 0);
  EXPECT_LT(metrics().at("energy_imbalance_percent"), 0.1);
}

// The command writes data: the same fabric, driven along them, reproduces them.
TEST_F(FabCommand, OnItsOwnRecordMeetsWhatItRecorded) {
  ASSERT_EQ(fab({{"fabric", "cotton-broad"}, {"fab.steps", 60}}),
            0);  // with fewer it reads between its rows
  const std::string record = (folder_.path() / "out" / "fab.csv").string();
  ASSERT_EQ(fab({{"fabric", "cotton-broad"}, {"fab.data", record}, {"no-images", true}}, "again"), 0);
  const auto m = metrics("again");
  constexpr double kSixDigits = 1e-4;
  for (const char* name : {"area_cycle1_J_per_m", "area_cycle3_J_per_m", "force_range_cycle2_N_per_m"}) {
    EXPECT_NEAR(m.at(name), metrics().at(name), kSixDigits * metrics().at(name).get<double>()) << name;
    EXPECT_NEAR(m.at(name), m.at(std::string("measured_") + name), kSixDigits * m.at(name).get<double>())
        << name;
  }
}

// Chords between four rows of a branch would leave out a fifth of the area.
TEST_F(FabCommand, ReadsLoopsBetweenFewRows) {
  const auto metrics = [&](int steps) {
    EXPECT_EQ(fab({{"fabric", "cotton-broad"}, {"fab.steps", steps}, {"no-images", true}}), 0);
    return metrics_of(folder_.path() / "out");
  };
  const Json few = metrics(4);
  const std::vector<FabLoops> written = read_fab(folder_.path() / "out" / "fab.csv", TesterUnits::si, "test");
  EXPECT_EQ(written[0].branches[0].distance.size(), 5u) << "as they are asked for";
  const Json many = metrics(60);
  constexpr double kSameState = 1e-6;  // relative; equilibria are solved to less
  for (const char* name : {"area_cycle1_J_per_m", "area_cycle3_J_per_m", "peak_force_cycle3_N_per_m"})
    EXPECT_NEAR(few[name].get<double>() / many[name].get<double>(), 1, kSameState) << name;
}

// `fit --fab` would not take the record.
TEST_F(FabCommand, SimulatesNoLoopsThatItWouldNotRead) {
  const auto said = [&](std::vector<Flag> flags) { return test::refusal([&] { fab(flags); }); };
  EXPECT_TRUE(says(said({{"fab.slack", 0.0055}, {"fab.compressions", "0.008"}}), "within 25 % of the gauge"));
  EXPECT_TRUE(says(said({{"fab.width", 2}}), "fab.width = 2 m must be in [0.001, 1]"));
  EXPECT_TRUE(says(said({{"fab.test", "S1"}, {"fab.compressions", "0.05"}}), "do not fit a gauge"));
  ASSERT_EQ(fab({{"fabric", "gray-interlock"}}), 0) << "whose loops enclose nothing";
  EXPECT_EQ(read_fab(folder_.path() / "out" / "fab.csv", TesterUnits::si, "test").size(), 1u);
}

TEST_F(FabCommand, FollowsStopsThatAFileStates) {
  const fs::path file = folder_.path() / "stops.toml";
  std::ifstream shipped(find_asset("fabrics", "cotton-broad-k50", "test"));
  std::ofstream text(file);
  for (std::string line; std::getline(shipped, line);)  // b1 and k0 follow from the stops
    if (!line.starts_with("b1 = {") && !line.starts_with("k0 = {")) text << line << "\n";
  text << "\n[bending.stops]\nthresholds = [10, 50]\nstiffnesses = [8e-6, 1e-6]\n"
          "[bending.stops.weft]\nthresholds = [10, 50]\nstiffnesses = [4e-6, 1e-6]\n";
  text.close();
  const std::vector<Flag> along_warp = {{"fabric", file.string()}, {"no-images", true}};
  std::vector<Flag> along_weft = along_warp, along_bias = along_warp;
  along_weft.push_back({"fab.direction", "W"});
  along_bias.push_back({"fab.direction", "B"});
  ASSERT_EQ(fab(along_warp, "l"), 0);
  ASSERT_EQ(fab(along_weft, "w"), 0);
  ASSERT_EQ(fab(along_bias, "b"), 0);
  const double l = metrics("l").at("area_cycle1_J_per_m"), w = metrics("w").at("area_cycle1_J_per_m");
  EXPECT_GT(l, w);
  EXPECT_NEAR(metrics("b").at("area_cycle1_J_per_m"), (l + w) / 2, 0.05 * l);
}

TEST_F(FabCommand, WarnsOfPartsOfAFabricThatItDoesNotSimulate) {
  const auto warnings = [&](const char* fabric) {
    EXPECT_EQ(fab({{"fabric", fabric}, {"fab.steps", 4}, {"no-images", true}}), 0);
    return manifest_in(folder_.path() / "out")["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings("cotton-broad-creasing"), "fab does not simulate its [bending.set]"));
  EXPECT_TRUE(says(warnings("cotton-broad-relaxing"), "fab does not simulate its [bending.branches]"));
  EXPECT_FALSE(says(warnings("cotton-broad"), "does not simulate"));
}

TEST_F(FabCommand, WarnsThatFacesThatDifferAreSimulatedByTheirMeans) {
  const fs::path file = folder_.path() / "sided.toml";
  std::ofstream(file) << "[parameters]\ndensity = 0.12\nthickness = 4e-4\nb1 = 3e-5\nb2 = 1e-5\nk0 = 40\n"
                         "back-bending = 0.5\n";
  const auto warnings = [&](const std::string& test) {
    EXPECT_EQ(fab({{"fabric", file.string()}, {"fab.test", test}, {"fab.steps", 4}, {"no-images", true}}), 0);
    return manifest_in(folder_.path() / "out")["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings("U1"), "back-bending = 0.5 and back-friction = 1 as the means of both sides"));
  EXPECT_FALSE(says(warnings("S1"), "means of both sides")) << "which bends nothing";
}

TEST_F(FabCommand, RefusesWhatNoTesterDoes) {
  EXPECT_TRUE(says(test::refusal([&] { fab({{"fab.test", "X1"}}); }), "U.."));
  EXPECT_TRUE(says(test::refusal([&] { fab({{"fab.direction", "Q"}}); }), "L | W | B"));
  EXPECT_TRUE(says(test::refusal([&] { fab({{"fab.compressions", "0.02"}}); }), "0.8 of"));
}

}  // namespace
}  // namespace hysteron::experiments
