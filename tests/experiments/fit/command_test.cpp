// These tests run `hysteron fit` from flags to its folder.
#include "experiments/fit/from_fab.h"
#include "experiments/fit/report.h"
#include "sim/base/atomic_file.h"
#include "sim/base/csv.h"
#include "sim/identification/decay_friction.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/folder.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron::experiments {
namespace {

class Fit : public testing::Test {
 protected:
  struct Captured {
    std::string &out, &err;
    ~Captured() {
      out = testing::internal::GetCapturedStdout();
      err = testing::internal::GetCapturedStderr();
    }
  };
  int fit(std::vector<Flag> flags) {
    flags.push_back({"out", out().string()});
    flags.push_back({"quiet", true});
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const Captured captured{said_, warned_};
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
    Table({{"curvature [1/m]", series.curvature}, {"moment [N]", series.moment}}).write(file);
    return file.string();
  }
  fs::path out() const { return folder_.path() / "out"; }
  Json metrics() const { return metrics_of(out()); }

  Folder folder_;
  std::string said_, warned_;
};

TEST_F(Fit, OfALoopWritesWhatTheInterfaceNamesAndAFabricThatIsReadBack) {
  ASSERT_EQ(
      fit({{"loop", loop("prandtl", {250, -250, 250})}, {"name", "sample \"7\""}, {"fabric.density", 0.2}}),
      0);
  for (const char* name : {"fabric.toml", "fit.csv", "plot_fit.png", "plot_fit.svg", "plot_residual.png",
                           "plot_residual.svg", "manifest.json", "report.html"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Json m = metrics();
  for (const char* key : {"b1_N_m", "b1_N_m_stderr", "b2_N_m", "b2_N_m_stderr", "k0_per_m", "k0_per_m_stderr",
                          "residual_rms_N", "iterations"})
    EXPECT_TRUE(m.at(key).is_number()) << key;
  EXPECT_EQ(m.at("undetermined"), Json::array());
  EXPECT_TRUE(says(said_, "undetermined: nothing"));
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
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

TEST_F(Fit, SaysAloudWhoseDensityAndThicknessItFillsIn) {
  ASSERT_EQ(fit({{"kes.b", 1.157e-5}, {"kes.2hb", 1.216e-3}, {"fabric.density", 0.2}}), 0);
  const std::string file = file_content(out() / "fabric.toml");
  const std::string kept = manifest_in(out()).at("warnings").dump();
  for (const std::string& text : {warned_, file, kept}) {
    EXPECT_TRUE(
        says(text, "thickness was not given: fabric.toml holds that of another fabric, cotton-broad"));
    EXPECT_FALSE(says(text, "density was not given"));
  }
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
  EXPECT_EQ(fabric.provenance.at("density").confidence, "given");
  EXPECT_EQ(fabric.provenance.at("thickness").confidence, "assumed");
  EXPECT_TRUE(says(fabric.provenance.at("thickness").source, "cotton-broad"));
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

// The amplitudes of a strip of 8 cm follow from k0 = 8/m and HB = 0.6 mN.
TEST_F(Fit, OfAFreeVibrationWritesTheThreeNumbersOfAFabric) {
  constexpr double kTenth = 0.1, kB = 1.16e-5, kHB = 6e-4, kK0 = 8;
  DecaySeries series;
  for (int i = 0; i < 15; ++i) series.time.push_back(0.15 * i);
  series.amplitude.assign(15, 0.03);
  series.amplitude = decay_by(series, {0.08, 0.1238, kB}, parabola_stops(2 * kHB / kK0, kK0), 0.03);
  const fs::path file = folder_.path() / "decay.csv";
  Table({{"time [s]", series.time}, {"amplitude [m]", series.amplitude}}).write(file);
  ASSERT_EQ(fit({{"decay", file.string()},
                 {"decay.length", 0.08},
                 {"fabric.density", 0.1238},
                 {"fabric.thickness", 3e-4},
                 {"kes.b", 1.16e-5}}),
            0);
  const Json m = metrics();
  EXPECT_NEAR(m.at("k0_per_m").get<double>() / kK0, 1, kTenth);
  EXPECT_NEAR(m.at("HB_N").get<double>() / kHB, 1, kTenth);
  EXPECT_GT(m.at("k0_per_m_stderr"), 0);
  EXPECT_GT(m.at("HB_N_stderr"), 0);
  EXPECT_EQ(m.at("undetermined"), Json::array());
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "t").fabric;
  EXPECT_EQ(fabric.b2, kB);
  EXPECT_DOUBLE_EQ(fabric.k0, m.at("k0_per_m"));
  EXPECT_NEAR(fabric.virgin_curve().friction_moment() / m.at("HB_N").get<double>(), 1, 1e-9);
  EXPECT_TRUE(fabric.bending.stops.empty());
}

TEST_F(Fit, RefusesRequestsThatMakeNoSense) {
  const std::string file = loop("prandtl", {250, -250, 250});
  const auto refuses = [&](const std::vector<Flag>& flags, const char* part) {
    const std::string reason = refusal(flags);
    EXPECT_TRUE(says(reason, part));
  };
  refuses({}, "needs one of --loop");
  refuses({{"loop", file}, {"kes.b", 1e-5}}, "not several");
  refuses({{"kes.b", 1e-5}}, "needs both --kes.b and --kes.2hb");
  refuses({{"virgin.b1", 1e-5}}, "needs both --virgin.b1 and --virgin.c1");
  refuses({{"kes.b", 1e-5}, {"kes.2hb", 1e-3}, {"law", "wong"}}, "law needs --loop (no --loop)");
  refuses({{"loop", file}, {"law", "wongg"}}, "wongg");
  refuses({{"fab", file}, {"fabric.density", 0.1}, {"loop", file}}, "not several");
  refuses({{"fab", file}, {"fabric.density", 0.1}, {"kes.2hb", 1e-3}}, "not several");
  refuses({{"decay", file}, {"decay.length", 0.1}, {"fabric.density", 0.1}, {"kes.b", 1e-5}, {"loop", file}},
          "not several");
  refuses({{"kes.b", 0}, {"kes.2hb", 1e-3}}, "must be > 0");
}

// Friction of 1 mN acts beside a spring that it exceeds tenfold.
TEST_F(Fit, WarnsOfALawThatDoesNotDescribeTheData) {
  const fs::path file = folder_.path() / "friction.csv";
  Column curvature{"curvature [1/m]", {}}, moment{"moment [N]", {}};
  for (int i = 0; i <= 120; ++i) {
    const double sign = i < 40 ? 1 : i < 80 ? -1 : 1, at = i < 40 ? i : i < 80 ? 80 - i : i - 80;
    curvature.values.push_back(5 * at);
    moment.values.push_back(1e-3 * sign + 1e-6 * 5 * at);
  }
  Table({curvature, moment}).write(file);
  ASSERT_EQ(fit({{"loop", file.string()}, {"law", "linear"}}), 0);
  EXPECT_TRUE(says(warned_, "warning: linear does not describe these data: it misses them by "));
  EXPECT_TRUE(says(manifest_in(out()).at("warnings").dump(), "linear does not"));
}

// The data are M = B K + c K^3: a line misses a curve that stiffens by some ten percent of the largest
// moment.
TEST_F(Fit, WarnsOfALawThatIsNotNearTheData) {
  const fs::path file = folder_.path() / "stiffens.csv";
  Column curvature{"curvature [1/m]", {}}, moment{"moment [N]", {}};
  for (int i = 0; i <= 40; ++i) {
    const double k = 5.0 * i;
    curvature.values.push_back(k);
    moment.values.push_back(1e-6 * k + 5e-5 * std::pow(k / 100, 3));
  }
  Table({curvature, moment}).write(file);
  ASSERT_EQ(fit({{"loop", file.string()}, {"law", "linear"}}), 0);
  const double share = metrics().at("residual_rms_percent");
  EXPECT_GT(share, 8);
  EXPECT_LT(share, 25);
  EXPECT_TRUE(says(warned_, "warning: linear is not near these data: it misses them by "));
  EXPECT_TRUE(says(warned_, "(--law all)"));
}

TEST_F(Fit, WarnsOfALoopWithoutTimesForLawsThatTakeTime) {
  const std::string file = loop("gong", {150, -150, 150});
  ASSERT_EQ(fit({{"loop", file}, {"law", "prandtl,gong"}}), 0);
  EXPECT_TRUE(says(warned_,
                   "loop.csv has no column time [s], and gong takes time: every row is taken as a "
                   "step of 1 s"));
  ASSERT_EQ(fit({{"loop", file}, {"param", "stops=8"}}), 0);
  EXPECT_TRUE(says(warned_, "param stops is not used: the law remembers by a stack"));
  EXPECT_EQ(warned_.find("takes time"), warned_.npos);
}

// B is given to a free vibration, without an error of it.
TEST_F(Fit, OfAFreeVibrationTakesTheGivenRigidityAsExact) {
  DecaySeries series;
  for (int i = 0; i < 10; ++i) series.time.push_back(0.15 * i);
  series.amplitude.assign(10, 0.02);
  const DecayQuestion question = {0.08, 0.1238, 1.16e-5, 5e-4};
  const Spectrum stops = friction_from_kes({1.16e-5, 4e-4}, {12, 1.6}).stops;
  const fs::path file = folder_.path() / "decay.csv";
  Table({{"time [s]", series.time}, {"amplitude [m]", decay_by(series, question, stops, 0.03)}}).write(file);
  ASSERT_EQ(
      fit({{"decay", file.string()}, {"decay.length", 0.08}, {"fabric.density", 0.1238}, {"kes.b", 1.16e-5}}),
      0);
  EXPECT_TRUE(says(said_, " N m (of kes.b, taken as exact), HB = "));
  EXPECT_EQ(said_.find("+- 0 "), said_.npos) << said_;
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
  EXPECT_FALSE(fabric.provenance.at("b2").standard_error.has_value());
}

// Amplitudes that no friction makes, with a noise that lets any pass.
TEST_F(Fit, OfAFreeVibrationIsDoubtedInWordsOfAmplitudes) {
  const fs::path file = folder_.path() / "decay.csv";
  Table({{"time [s]", {0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.05}},
         {"amplitude [m]", {0.03, 0.03, 0.001, 0.03, 0.001, 0.02, 0.001, 0.001}}})
      .write(file);
  ASSERT_EQ(fit({{"decay", file.string()},
                 {"decay.length", 0.08},
                 {"decay.noise", 0.5},
                 {"fabric.density", 0.1238},
                 {"kes.b", 1.16e-5}}),
            0);
  EXPECT_TRUE(says(warned_, "the fit misses the fitted amplitudes by ")) << warned_;
  for (const char* other : {"forces", "gauge", "predictions.csv", "cycles"})
    EXPECT_EQ(warned_.find(other), warned_.npos) << other;
}

TEST_F(Fit, DoubtsAKesPairThatNoWovenClothHas) {
  ASSERT_EQ(fit({{"kes.b", 1.157e-5}, {"kes.2hb", 1.216e-5}}), 0);
  EXPECT_TRUE(says(warned_, "kes.2hb is 1.05 1/m of kes.b, and woven cloth has 16 to 300")) << warned_;
}

// A bilinear loop between -150 and 150/m, whose tester's zero is 20/m off.
TEST_F(Fit, WarnsOfACurvatureWhoseZeroIsOffAndFindsItOnRequest) {
  for (const double offset : {0.0, 20.0}) {
    const fs::path file = folder_.path() / "off.csv";
    Column curvature{"curvature [1/m]", {}}, moment{"moment [N]", {}};
    for (int i = 0; i <= 150; ++i) {
      const double k = i <= 30 ? 5.0 * i : i <= 90 ? 150 - 5.0 * (i - 30) : -150 + 5.0 * (i - 90);
      const double sign = i <= 30 || i > 90 ? 1 : -1;
      curvature.values.push_back(k + offset);
      moment.values.push_back(i == 0 ? 0 : 1e-5 * k + sign * 2e-4);
    }
    Table({curvature, moment}).write(file);
    ASSERT_EQ(fit({{"loop", file.string()}, {"law", "bilinear"}}), 0);
    EXPECT_EQ(says(warned_, "the zero of curvature seems to be off by 20 1/m"), offset > 0) << warned_;
    ASSERT_EQ(fit({{"loop", file.string()}, {"law", "bilinear"}, {"curvature-offset", true}}), 0);
    EXPECT_FALSE(says(warned_, "the zero of curvature"));
    EXPECT_NEAR(metrics().at("curvature_offset_per_m"), offset, 0.1) << "of an amplitude of 150/m";
    EXPECT_NEAR(metrics().at("b2_N_m"), 1e-5, 1e-8) << "the slope beyond the knee";
  }
}

// These tests check the warnings of a fit of loops, beside another form.
TEST(FitWarnings, NameAFormThatDescribesTheLoopsFarBetterAndFrictionBeyondTheirReach) {
  FabBending found;
  found.direction = "L";
  found.law = {1e-5, {10, 1000}, {2e-5, 1e-6}};  // HB = 2e-4 + 1e-3 N
  found.rows = 50;
  found.converged = true;
  found.noise = 7.5e-4;
  const auto leaves = [](FabBending& fit, double rms) {
    fit.residual_rms = rms;
    fit.residuals = Eigen::VectorXd(50);
    for (int i = 0; i < 50; ++i) fit.residuals[i] = (i % 2 ? rms : -rms) * (i % 3 ? 1.2 : 0.6);
  };
  leaves(found, 1.2);
  found.residual_share = 0.12;
  found.reach = 200;
  FabBending stops = found;
  leaves(stops, 0.14);
  const std::vector<std::string> warnings = bending_warnings(found, {{"9 stops", stops}}, {});
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_TRUE(says(warnings[0], "misses the fitted loops by 12 % of the range"));
  EXPECT_TRUE(says(warnings[1], "9 stops leave 0.14 of the noise (rms), and the form asked for 1.2"));
  EXPECT_TRUE(says(warnings[2], "83 % of HB slips")) << "1e-3 of 1.2e-3 N";
  leaves(found, 0.14);
  found.residual_share = 0.01;
  found.reach = 2000;
  EXPECT_TRUE(bending_warnings(found, {{"9 stops", stops}}, {}).empty());
}

// The loops of a known law, as `fab` writes them, in the columns that are read.
class FitOfFab : public Fit {
 protected:
  FitOfFab() {
    testing::internal::CaptureStdout();
    experiment_named("fab").run({"fab",
                                 "hysteron fab",
                                 {{"fabric", "cotton-broad"},
                                  {"fab.compressions", "0.004,0.006"},
                                  {"fab.steps", 6},
                                  {"no-images", true},
                                  {"out", (folder_.path() / "made").string()},
                                  {"json", true},
                                  {"quiet", true}},
                                 {}});
    testing::internal::GetCapturedStdout();
  }
  std::vector<Flag> flags(const std::string& file) const {
    return {{"fab", file},
            {"fab.thresholds", "5,20"},
            {"fabric.density", cotton_.density},
            {"fabric.thickness", 5e-4}};
  }
  std::string made() const { return (folder_.path() / "made" / "fab.csv").string(); }
  // The same rows after a change of each: columns direction, test, branch, distance, force, gauge, width.
  template <class Change>
  std::string changed(const Change& change) const {
    Table table = read_table(made());
    const std::string file = (folder_.path() / "changed.csv").string();
    for (auto& row : table.rows) change(row);
    table.write(file);
    return file;
  }
  const Fabric cotton_ = read_fabric("cotton-broad", "test").fabric;
};

TEST_F(FitOfFab, FindsTheirFrictionAndPredictsWhatWasNotFitted) {
  ASSERT_EQ(fit(flags(made())), 0);
  for (const char* name :
       {"fabric.toml", "one_stop.toml", "spectrum.csv", "predictions.csv", "loops_L_D1.csv", "plot_L_D1.png"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const Json m = metrics();
  const double friction = cotton_.virgin_curve().friction_moment();
  EXPECT_NEAR(m.at("L.HB_N"), friction, 0.1 * friction);  // thresholds are not the law's
  EXPECT_TRUE(m.at("undetermined").is_array());
  const Table predictions = read_table(out() / "predictions.csv");
  ASSERT_EQ(predictions.rows.size(), 2u);
  EXPECT_EQ(predictions.rows[0][2], "0");
  EXPECT_EQ(predictions.rows[1][2], "1");
  for (const auto& row : predictions.rows) EXPECT_LT(std::abs(std::stod(row[5])), 10) << row[0];
  EXPECT_EQ(warned_, "");
}

// The force is one that no strip has, ten times the noise, up and down from row to row.
TEST_F(FitOfFab, FarOutsideTheNoiseIsRefusedUnlessTheNoiseIsSaidToBeThatLarge) {
  double sign = 1;
  const std::string file = changed([&](std::vector<std::string>& row) {
    row[4] = number_text(std::stod(row[4]) + 7.5e-3 * (sign = -sign));
  });
  std::vector<Flag> stops = flags(file);
  stops.push_back({"fab.friction", "stops"});
  const std::string reason = refusal(stops);
  EXPECT_TRUE(says(reason, "along L the fit misses the forces by "));
  EXPECT_TRUE(says(reason, "times their noise of 0.00075 N (rms), at most 3 times"));
  EXPECT_TRUE(says(reason, "are fitted with --fab.noise 0.00"));
  std::vector<Flag> noisy = stops;
  noisy.push_back({"fab.noise", 7.5e-3});
  EXPECT_EQ(fit(noisy), 0);
}

// Grams of force that are called newtons.
TEST_F(FitOfFab, OfForcesInAnotherUnitIsRefusedAsNoFabric) {
  const std::string file =
      changed([](std::vector<std::string>& row) { row[4] = number_text(std::stod(row[4]) / 9.80665e-3); });
  const std::string reason = refusal(flags(file));
  EXPECT_TRUE(says(reason, "must be in [1e-08, 0.001] N m, as fabrics are"));
}

TEST_F(FitOfFab, OfLoopsThatNoTesterRecordsIsRefusedBeforeAnythingIsWritten) {
  const auto refuses = [&](const auto& change, const char* part) {
    const std::string reason = refusal(flags(changed(change)));
    EXPECT_TRUE(says(reason, part));
  };
  using Row = std::vector<std::string>;
  refuses([](Row& row) { row[4] = "0"; }, "must vary");
  refuses([](Row& row) { row[4] = number_text(-std::stod(row[4])); }, "turn the sign of the forces");
  int place = 0;
  refuses([&](Row& row) { row[3] = number_text(0.0195 - 0.004 * (place++ * 7 % 13) / 13); },
          "lie back by more than");
}

TEST_F(FitOfFab, TakesWarpBeforeWeftWhateverTheirOrderInTheFile) {
  const Table made_table = read_table(made());
  const std::string file = (folder_.path() / "both.csv").string();
  Table table(made_table.head);
  for (const char* direction : {"B", "W", "L"})
    for (const std::vector<std::string>& row : made_table.rows) {
      table.rows.push_back(row);
      table.rows.back()[0] = direction;
    }
  table.write(file);
  std::vector<Flag> stops = flags(file);
  stops.push_back({"fab.friction", "stops"});  // the form that is fitted soonest
  ASSERT_EQ(fit(stops), 0);
  const Json m = metrics();
  EXPECT_TRUE(m.contains("L.HB_N") && m.contains("W.HB_N"));
  EXPECT_FALSE(m.contains("B.HB_N")) << "a bias is fitted where it is asked for";
  const Fabric fabric = read_fabric((out() / "fabric.toml").string(), "--fabric").fabric;
  EXPECT_TRUE(says(fabric.provenance.at("b2").source, "along L, W in both.csv"));
  EXPECT_TRUE(says(manifest_in(out())["warnings"].dump(), "--fab.directions L,W,B fits them"));
  std::vector<Flag> bias = flags(file);
  bias.push_back({"fab.directions", "L,B"});
  EXPECT_TRUE(says(test::refusal([&] { fit(bias); }), "must begin with warp and weft"));
  bias.back() = {"fab.cycles", "inf"};
  EXPECT_TRUE(says(test::refusal([&] { fit(bias); }), "must be numbers > 0"));
  bias.back() = {"fab.cycles", "1.5"};
  EXPECT_TRUE(says(test::refusal([&] { fit(bias); }), "must be whole numbers"));
}

TEST_F(Fit, OfLoopsOfAFabTesterNeedsDensityAndTheRightUnits) {
  const std::string file =
      folder_.write("fab.csv",
                    "direction,test,branch,clamp_distance_m,force_N,gauge_length_m,width_m\n"
                    "L,D1,0,0.018,0,0.021,0.04\n");
  EXPECT_TRUE(says(refusal({{"fab", file}}), "fabric.density"));
  EXPECT_TRUE(says(refusal({{"fab", file}, {"units", "fab"}, {"fabric.density", 0.3}}), "give --units si"));
  EXPECT_TRUE(says(refusal({{"fab", file}, {"units", "kes"}, {"fabric.density", 0.3}}), "fab (cm, gf)"));
  EXPECT_TRUE(says(refusal({{"loop", file}, {"units", "fab"}}), "--fab"));
}

}  // namespace
}  // namespace hysteron::experiments
