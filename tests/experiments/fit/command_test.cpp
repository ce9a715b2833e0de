// `hysteron fit` from flags to its folder.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/fit/report.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

class Fit : public testing::Test {
 protected:
  struct Captured {
    std::string& text;
    ~Captured() { text = testing::internal::GetCapturedStdout(); }
  };
  int fit(std::vector<Flag> flags) {
    flags.push_back({"out", out().string()});
    flags.push_back({"quiet", "true"});
    testing::internal::CaptureStdout();
    const Captured captured{said_};
    return experiment_named("fit").run({"fit", "hysteron fit", flags, {}});
  }
  std::string refusal(const std::vector<Flag>& flags) {
    const std::string message = test::refusal([&] { fit(flags); });
    EXPECT_FALSE(fs::exists(out())) << "a folder for a refused request";
    return message;
  }
  std::string loop(const char* law, const std::vector<double>& turns) {
    const fs::path file = folder_.path() / "loop.csv";
    const MomentSeries series = measured(law, kCotton, turns, 0.02, 1);
    write_csv(file, {{{"curvature [1/m]", series.curvature}, {"moment [N]", series.moment}}, {}});
    return file.string();
  }
  fs::path out() const { return folder_.path() / "out"; }
  Json metrics() const { return Json::parse(text_of(out() / "manifest.json")).at("metrics"); }

  Folder folder_;
  std::string said_;
};

TEST_F(Fit, OfALoopWritesWhatTheInterfaceNames) {
  ASSERT_EQ(fit({{"loop", loop("prandtl", {250, -250, 250})}}), 0);
  for (const char* name : {"fabric.toml", "fit.csv", "plot_fit.png", "plot_fit.svg", "plot_residual.png",
                           "plot_residual.svg", "manifest.json", "report.html"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Json m = metrics();
  for (const char* key : {"b1_N_m", "b1_N_m_stderr", "b2_N_m", "b2_N_m_stderr", "k0_per_m", "k0_per_m_stderr",
                          "residual_rms_N", "iterations"})
    EXPECT_TRUE(m.at(key).is_number()) << key;
  EXPECT_EQ(m.at("undetermined"), Json::array());
  EXPECT_NE(said_.find("undetermined: nothing"), std::string::npos) << said_;
}

TEST_F(Fit, WritesAFabricThatIsReadBackWithItsStandardErrors) {
  ASSERT_EQ(
      fit({{"loop", loop("prandtl", {250, -250, 250})}, {"name", "sample \"7\""}, {"fabric.density", "0.2"}}),
      0);
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
  const Json m = metrics();
  EXPECT_EQ(fabric.name, "sample \"7\"");
  EXPECT_EQ(fabric.b1, m.at("b1_N_m").get<double>());
  EXPECT_EQ(fabric.b2, m.at("b2_N_m").get<double>());
  EXPECT_EQ(fabric.k0, m.at("k0_per_m").get<double>());
  EXPECT_EQ(fabric.density, 0.2);
  EXPECT_EQ(fabric.provenance.at("b1").confidence, "fitted");
  EXPECT_EQ(fabric.provenance.at("b1").standard_error, m.at("b1_N_m_stderr").get<double>());
  EXPECT_EQ(fabric.provenance.at("thickness").confidence, "assumed");
  EXPECT_FALSE(fabric.provenance.at("thickness").standard_error.has_value());
}

TEST_F(Fit, MarksWhatItAssumesInTheFabric) {
  ASSERT_EQ(fit({{"kes.b", "1.157e-5"}, {"kes.2hb", "1.216e-3"}}), 0);
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
  EXPECT_EQ(fabric.provenance.at("b2").confidence, "given");
  EXPECT_EQ(fabric.provenance.at("k0").confidence, "assumed");
  EXPECT_EQ(metrics().at("undetermined"), (Json{"b1", "k0"}));
  EXPECT_TRUE(metrics().at("k0_per_m_stderr").is_null());
}

TEST_F(Fit, SaysAloudWhoseDensityAndThicknessItFillsIn) {
  ASSERT_EQ(fit({{"kes.b", "1.157e-5"}, {"kes.2hb", "1.216e-3"}, {"fabric.density", "0.2"}}), 0);
  const std::string file = text_of(out() / "fabric.toml");
  for (const std::string& text : {said_, file}) {
    EXPECT_NE(text.find("WARNING: thickness was not given"), std::string::npos) << text;
    EXPECT_NE(text.find("ANOTHER fabric, cotton-broad"), std::string::npos) << text;
    EXPECT_EQ(text.find("WARNING: density"), std::string::npos) << text;
  }
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
  EXPECT_EQ(fabric.provenance.at("density").confidence, "given");
  EXPECT_EQ(fabric.provenance.at("thickness").confidence, "assumed");
  EXPECT_NE(fabric.provenance.at("thickness").source.find("cotton-broad"), std::string::npos);
}

TEST_F(Fit, ComparesLawsOnTheSameDataTheBestFirst) {
  ASSERT_EQ(fit({{"loop", loop("bilinear", {150, 100, 150, -150, 150})}, {"law", "linear,prandtl,bilinear"}}),
            0);
  const Json m = metrics();
  EXPECT_EQ(m.at("best_law"), "bilinear");
  const auto rms = [&](const std::string& law) { return m.at(law + ".residual_rms_N").get<double>(); };
  EXPECT_LT(rms("bilinear"), rms("prandtl"));
  EXPECT_LT(rms("prandtl"), rms("linear"));
  EXPECT_LT(said_.find("bilinear"), said_.find("prandtl"));
  EXPECT_NO_THROW(
      read_csv(out() / "fit.csv", {"curvature [1/m]", "model_prandtl [N]", "residual_linear [N]"}, {}, "t"));
}

TEST_F(Fit, OfAllLawsKeepsTheLawThatWroteTheData) {
  ASSERT_EQ(fit({{"loop", loop("prandtl", {150, 90, 150, -150, -110, -150, 100})}, {"law", "all"}}), 0);
  EXPECT_EQ(metrics().at("best_law"), "prandtl");
}

TEST_F(Fit, OfFrictionElementsListsThemWithTheIterationsItTook) {
  ASSERT_EQ(fit({{"loop", loop("prandtl", {250, -250, 250})}, {"stops", "2"}}), 0);
  const Table stops = read_csv(out() / "stops.csv", {"threshold [1/m]", "stiffness [N m]"}, {}, "test");
  EXPECT_EQ(stops.lines.size(), 2u);
  EXPECT_GT(metrics().at("iterations").get<int>(), 0);
  EXPECT_TRUE(metrics().at("stop1_threshold_per_m_stderr").is_number());
}

TEST_F(Fit, RefusesRequestsThatMakeNoSense) {
  const std::string file = loop("prandtl", {250, -250, 250});
  const auto says = [&](const std::vector<Flag>& flags, const char* part) {
    const std::string reason = refusal(flags);
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  };
  says({}, "needs one of --loop");
  says({{"loop", file}, {"kes.b", "1e-5"}}, "not several");
  says({{"kes.b", "1e-5"}}, "needs both --kes.b and --kes.2hb");
  says({{"virgin.b1", "1e-5"}}, "needs both --virgin.b1 and --virgin.c1");
  says({{"kes.b", "1e-5"}, {"kes.2hb", "1e-3"}, {"law", "wong"}}, "go with --loop");
  says({{"profile", "p.csv"}}, "needs --fabric.density");
  says({{"loop", file}, {"law", "wongg"}}, "wongg");
  says({{"loop", file}, {"stops", "99"}}, "stops = 99");
  says({{"loop", file}, {"stops", "0"}}, "stops = 0 must be in [1, ");
  says({{"kes.b", "0"}, {"kes.2hb", "1e-3"}}, "must be > 0");
}

TEST(Fabric, WithANegativeStandardErrorIsRefused) {
  const Folder folder;
  Identification found;
  found.b1 = {2e-5, 1e-7, true, "test"};
  found.b2 = {1e-5, -1e-7, true, "test"};
  found.k0 = {50, 1, true, "test"};
  write_fabric(folder.path() / "f.toml", found, {"f", "a test", {}, {}});
  try {
    read_fabric((folder.path() / "f.toml").string(), "--fabric");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("stderr must be >= 0"), std::string::npos) << error.what();
  }
}

// The loops of a known law, as `fab` writes them, in the columns that are read.
TEST_F(Fit, OfLoopsOfAFabTesterFindsTheirFrictionAndPredictsWhatWasNotFitted) {
  const fs::path made = folder_.path() / "made";
  ASSERT_EQ(experiment_named("fab").run({"fab",
                                         "hysteron fab",
                                         {{"fabric", "cotton-broad"},
                                          {"fab.compressions", "0.004,0.006"},
                                          {"fab.steps", "12"},
                                          {"no-images", "true"},
                                          {"out", made.string()},
                                          {"json", "true"},
                                          {"quiet", "true"}},
                                         {}}),
            0);
  const Fabric cotton = read_fabric("cotton-broad", "test").fabric;
  ASSERT_EQ(fit({{"fab", (made / "fab.csv").string()},
                 {"fab.thresholds", "5,20,40"},
                 {"fabric.density", number_text(cotton.density)},
                 {"fabric.thickness", "5e-4"}}),
            0);
  for (const char* name :
       {"fabric.toml", "one_stop.toml", "spectrum.csv", "predictions.csv", "plot_L_D1.png"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Json m = metrics();
  const double friction = cotton.virgin_curve().friction_moment();
  EXPECT_NEAR(m.at("L.HB_N"), friction, 0.1 * friction);  // thresholds are not the law's
  EXPECT_TRUE(m.at("undetermined").is_array());
  const TextTable predictions = read_words(out() / "predictions.csv");
  ASSERT_EQ(predictions.rows.size(), 2u);
  EXPECT_EQ(predictions.rows[0][2], "0");
  EXPECT_EQ(predictions.rows[1][2], "1");
  for (const auto& row : predictions.rows) EXPECT_LT(std::abs(std::stod(row[5])), 10) << row[0];
}

TEST_F(Fit, OfLoopsOfAFabTesterNeedsDensityAndTheRightUnits) {
  const fs::path file = folder_.path() / "fab.csv";
  std::ofstream(file) << "direction,test,branch,clamp_distance_m,force_N,gauge_length_m,width_m\n"
                         "L,D1,0,0.018,0,0.021,0.04\n";
  EXPECT_NE(refusal({{"fab", file.string()}}).find("fabric.density"), std::string::npos);
  EXPECT_NE(refusal({{"fab", file.string()}, {"units", "fab"}, {"fabric.density", "0.3"}}).find("_cm"),
            std::string::npos);
  EXPECT_NE(
      refusal({{"fab", file.string()}, {"units", "kes"}, {"fabric.density", "0.3"}}).find("fab (cm, gf)"),
      std::string::npos);
  EXPECT_NE(refusal({{"loop", file.string()}, {"units", "fab"}}).find("--fab"), std::string::npos);
}

}  // namespace
}  // namespace hysteron::experiments
