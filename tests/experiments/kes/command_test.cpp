// These tests run `hysteron kes` of the law alone: its metrics, tables and flags.
#include <fstream>

#include "experiments/workbench/pages/closing_summary.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr double kRounding = 1e-9;  // relative: sums of some thousand rows

std::vector<std::string> all_laws() {
  std::vector<std::string> names;
  for (const LawEntry& law : law_catalogue()) names.push_back(law.name);
  return names;
}

class KesCommand : public testing::Test {
 protected:
  Json run(std::vector<Flag> flags) {
    flags.push_back({"quick", true});
    EXPECT_EQ(run_into(folder_.path(), "kes", std::move(flags)), 0);
    return manifest_in(folder_.path());
  }
  Folder folder_;
};

TEST_F(KesCommand, PrefixesMetricsByTheLawWhereThereAreSeveral) {
  EXPECT_TRUE(run({})["metrics"].contains("2HB_N"));
  EXPECT_TRUE(run({{"law", "wong,linear"}})["metrics"].contains("wong.2HB_N"));
}

TEST_F(KesCommand, TestsEveryLawAndWritesItsTables) {
  const Json manifest = run({{"law", "all"}});
  EXPECT_TRUE(manifest["complete"]);
  const std::string summary = closing_summary(folder_.path());
  for (const std::string& law : all_laws()) {
    for (const char* key : {"B_N_m", "2HB_N", "residual_curvature_per_m", "loop_area_J_per_m2"})
      EXPECT_TRUE(manifest["metrics"][law + "." + key].is_number()) << law << " " << key;
    EXPECT_TRUE(says(summary, "\n  " + law + " "));
  }
  for (const char* file : {"loops.csv", "table.csv", "report.html"})
    EXPECT_TRUE(fs::exists(folder_.path() / file)) << file;
}

TEST_F(KesCommand, ReadsFaceAndBackWhereTheyDiffer) {
  constexpr double kReads = 5e-3;
  const Json manifest =
      run({{"law", "prandtl,wong"}, {"fabric.back-bending", 1.3}, {"fabric.back-friction", 0.8}});
  const auto number = [&](const char* metric) { return manifest["metrics"][metric].get<double>(); };
  EXPECT_NEAR(number("prandtl.B_back_N_m") / number("prandtl.B_face_N_m"), 1.3, kReads);
  EXPECT_NEAR(number("prandtl.2HB_back_N") / number("prandtl.2HB_face_N"), 0.8, kReads);
  EXPECT_NEAR(number("wong.B_N_m") / number("prandtl.B_face_N_m"), 1.15, kReads) << "the mean";
  EXPECT_NEAR(number("wong.2HB_N") / number("prandtl.2HB_face_N"), 0.9, kReads);
  const std::string warnings = manifest["warnings"].dump();
  EXPECT_TRUE(
      says(warnings, "fabric.back-bending = 1.3 and fabric.back-friction = 0.8 are not followed: law wong"));
  EXPECT_FALSE(says(warnings, "law prandtl"));
  EXPECT_FALSE(run({})["metrics"].contains("B_back_N_m")) << "of a fabric whose sides are alike";
}

TEST_F(KesCommand, WarnsOfUnusualFabricsAndOfParametersThatChangeNothing) {
  EXPECT_TRUE(run({}).value("warnings", Json::array()).empty());
  const std::string unusual = run({{"fabric.b1", 0.3}})["warnings"].dump();
  EXPECT_TRUE(says(unusual, "fabric.b1 = 0.3 N m (--fabric.b1) is unusual"));
  const std::string unused = run({{"param", "stops=4"},
                                  {"fabric.bending.stops.thresholds", Numbers{4, 20}},
                                  {"fabric.bending.stops.stiffnesses", Numbers{3e-5, 5e-6}}})["warnings"]
                                 .dump();
  EXPECT_TRUE(says(unused, "param stops is not used: the 2 stops of cotton-broad are the law's memory"));
  const fs::path file = folder_.path() / "rubs-otherwise.toml";
  std::ofstream(file) << "[parameters]\ndensity = 0.12\nthickness = 4e-4\nb2 = 1e-5\nb1 = 6e-5\nk0 = 8\n"
                         "weft-bending = 1\nweft-friction = 0.5\nwarp = 200\nweft = 200\nshear = 40\n"
                         "damping = 1e-3\nfriction = 0.3\n";
  const std::string along_weft =
      run({{"law", "gong"}, {"along", "weft"}, {"fabric", file.string()}})["warnings"].dump();
  EXPECT_TRUE(says(along_weft, "fabric.weft-friction = 0.5 changes nothing: law gong"));
  const std::string stops_along_weft =
      run({{"law", "wong"},
           {"along", "weft"},
           {"fabric.bending.stops.thresholds", Numbers{4, 20}},
           {"fabric.bending.stops.stiffnesses", Numbers{3e-5, 5e-6}},
           {"fabric.bending.stops.weft.thresholds", Numbers{4, 20}},
           {"fabric.bending.stops.weft.stiffnesses", Numbers{1e-5, 2e-6}}})["warnings"]
          .dump();
  EXPECT_TRUE(
      says(stops_along_weft, "fabric.bending.stops.weft of cotton-broad changes nothing under law wong"));
  const std::string tension = run({{"test", "tension"}, {"fabric.warp", 2e6}})["warnings"].dump();
  EXPECT_TRUE(says(tension, "fabric.warp = 2e+06 N/m (--fabric.warp) is unusual"));
}

TEST_F(KesCommand, WarnsOfStepsThatAreTooLongForTheAreaOfALoop) {
  const auto warnings = [&](const std::vector<Flag>& flags) {
    return run(flags).value("warnings", Json::array()).dump();
  };
  EXPECT_EQ(warnings({{"steps", 10}}), "[]") << "of a law that takes no time";
  EXPECT_TRUE(
      says(warnings({{"steps", 10}, {"law", "kim"}}), "law kim, steps = 10: the area of the loop is "));
  const std::vector<Flag> strip = {{"on", "strip"}, {"cloth.width", 1e-3}};
  EXPECT_EQ(warnings(strip), "[]");
  std::vector<Flag> coarse = strip;
  coarse.push_back({"strip-steps", 10});
  EXPECT_TRUE(says(warnings(coarse), "strip under law prandtl, strip-steps = 10: the area of the loop is "));
}

TEST_F(KesCommand, TakesAFabricsNumbersFromFlags) {
  const Json manifest = run({{"fabric", "cotton_broad"}, {"fabric.b2", 2e-5}, {"law", "linear"}});
  EXPECT_NEAR(manifest["metrics"]["B_N_m"].get<double>(), 2e-5, kRounding * 2e-5);
  EXPECT_EQ(manifest["scene"]["fabric"]["b2"], 2e-5);
  EXPECT_EQ(manifest["scene"]["fabric"]["provenance"]["b2"]["confidence"], "given");
}

TEST_F(KesCommand, GivesParametersToTheLawsThatHaveThem) {
  const Json metrics = run({{"law", "linear,wong"}, {"param", "recovery=reversible"}})["metrics"];
  EXPECT_TRUE(metrics.contains("linear.B_N_m"));
  EXPECT_THROW(experiment_named("kes").run(
                   {"kes", "", {{"law", "linear,pabst"}, {"param", "recovery=reversible"}}, {}}),
               Error);
}

}  // namespace
}  // namespace hysteron::experiments
