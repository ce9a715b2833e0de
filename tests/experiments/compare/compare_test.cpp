// Methods side by side: what is made equal, what stands on the page, what is not run again.
#include <cmath>
#include <map>

#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/compare/matching.h"
#include "experiments/workbench/compare/variants.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "render/color_map.h"
#include "render/comparison_sheet.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const VirginCurve kCurve{2e-5, 5e-6, 40};  // b1, b2 [N m], k0 [1/m]

LawRequest law_called(const std::string& name) { return {name, kCurve, {}}; }

// The virgin curve has the moment b1 K - (b1 - b2) K^2/(2 k0) to k0, then M0 + b2 K.
TEST(Matching, OfEnergyGivesEqualWorkToTheCurvature) {
  const double k = 100, m0 = (kCurve.b1 - kCurve.b2) * kCurve.k0 / 2;
  const double work =
      kCurve.b2 * k * k / 2 + m0 * (k - kCurve.k0) + (kCurve.b1 - kCurve.b2) * kCurve.k0 * kCurve.k0 / 3;
  EXPECT_NEAR(bending_work(law_called("prandtl"), k) / work, 1, 1e-5);
  const double scale = matching_scale(law_called("linear"), law_called("prandtl"), Match::energy, k);
  EXPECT_NEAR(scale / (work / (kCurve.b2 * k * k / 2)), 1, 1e-5);
  LawRequest stiffer = law_called("linear");
  stiffer.curve.b1 *= scale;
  stiffer.curve.b2 *= scale;
  EXPECT_NEAR(bending_work(stiffer, k) / bending_work(law_called("prandtl"), k), 1, 1e-8);
}

TEST(Matching, OfSmallStrainGivesTheInitialSlope) {
  EXPECT_NEAR(matching_scale(law_called("linear"), law_called("prandtl"), Match::small_strain, 1),
              kCurve.b1 / kCurve.b2, 1e-4);
  EXPECT_EQ(matching_scale(law_called("linear"), law_called("prandtl"), Match::fabric, 1), 1);
}

LawRequest sided(const std::string& name, double bending, double friction) {
  LawRequest law = law_called(name);
  law.curve.parts.faces.bending = bending;
  law.curve.parts.faces.friction = friction;
  return law;
}

LawRequest mean_sided(const std::string& name, double bending, double friction) {
  LawRequest law = sided(name, bending, friction);
  law.curve = mean_of_faces(law.curve);
  return law;
}

// The excess of a side's elasticity begins at K = 0: its mean work and slope are those of the mean B.
TEST(Matching, IsOfTheMeanOfBothSidesWhereTheyDiffer) {
  constexpr double kCurvature = 100, kRounding = 1e-8;  // [1/m]; matches are exact to 1e-9
  constexpr double kStops = 1e-4;  // a law with sides has its parabola in stops, one without exactly
  EXPECT_EQ(
      bending_work(sided("linear", 0.5, 1), -kCurvature) / bending_work(law_called("linear"), kCurvature),
      0.5);
  for (const Match match : {Match::energy, Match::small_strain}) {
    EXPECT_NEAR(matching_scale(law_called("linear"), sided("linear", 0.5, 1), match, kCurvature), 0.75,
                kRounding);
    for (const char* law : {"linear", "pabst", "dahl"})
      EXPECT_NEAR(
          matching_scale(sided(law, 0.5, 1), sided("prandtl", 0.5, 1), match, kCurvature) /
              matching_scale(mean_sided(law, 0.5, 1), mean_sided("prandtl", 0.5, 1), match, kCurvature),
          1, kStops)
          << law;
  }
}

// Friction changes from one side's to the other's within w = 10/m about flat, which takes w/4 from the path
// of the excess: 0.0025 of a tenth of the work.  The face alone is 0.016 away.
TEST(Matching, IsOfBothSidesFriction) {
  constexpr double kCurvature = 1000, kChange = 1e-3;
  EXPECT_NEAR(matching_scale(sided("pabst", 1, 1.3), sided("prandtl", 1, 1.3), Match::energy, kCurvature) /
                  matching_scale(mean_sided("pabst", 1, 1.3), mean_sided("prandtl", 1, 1.3), Match::energy,
                                 kCurvature),
              1, kChange);
}

TEST(Outline, IsTheEdgeOfTheSilhouetteOnly) {
  render::Image shape(100, 100, render::Rgb8{255, 255, 255}), target = shape;
  render::draw_rectangle(shape, 20, 30, 60, 70, {0, 0, 0});
  const render::Rgb8 color = render::method_color(1);
  render::draw_outline(target, shape, color, 1);
  int colored = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) colored += target.at(x, y)[1] == color[1];
  EXPECT_EQ(colored, 4 * 40 - 4);
  EXPECT_THROW(render::draw_outline(target, render::Image(10, 10), color, 1), Error);
}

const std::string kSmallWithTimes =
    " --triangles 60 --seconds 0.1 --fps 30 --device cpu --size 160x120 --quality draft --quiet";
const std::string kSmall = kSmallWithTimes + " --compare.rows 2";

double first_stiffness(const FinishedRun& run) {
  return run.manifest()["scene"]["columns"][0]["stiffness_times"];
}

// A difference that a page shows between laws is one of kind, not of stiffness, unless the fabric's own
// numbers are asked for.
TEST(Compare, SetsLawsOfEqualWorkSideBySideWithTheirPlots) {
  const FinishedRun run("compare swing --laws linear,prandtl" + kSmall + " --seconds 1 --fps 5");
  for (const char* name :
       {"sheet.png", "plot_tip_height.png", "plot_decay.svg", "report.html", "linear/manifest.json",
        "prandtl/frames/0003.png", "prandtl/frames-silhouette/0003.png"})
    EXPECT_TRUE(fs::exists(run.out / name)) << name;
  EXPECT_TRUE(file_content(run.out / "table.csv").starts_with("law,"));
  EXPECT_GT(file_content(run.out / "linear/turns.csv").size(), 40u);
  EXPECT_GT(first_stiffness(run), 1.2);
  const auto metrics = run.metrics();
  EXPECT_EQ(metrics["linear.bending_friction_J"].get<double>(), 0);
  EXPECT_GT(metrics["prandtl.bending_friction_J"].get<double>(), 0);
}

// b1 follows from the stops: a file of `fit --fab.friction stops` has no other.
TEST(Compare, MatchesAFabricThatHasStops) {
  constexpr double kDigits = 1e-6;
  const Folder folder;
  const std::string fabric =
      folder.write("stops.toml",
                   "[parameters]\nb2 = 1e-5\ndensity = 0.12\nthickness = 5e-4\n"
                   "[bending.stops]\nthresholds = [10, 40]\nstiffnesses = [2e-5, 1e-5]\n");
  const FinishedRun run("compare swing --laws linear,prandtl --no-images --fabric " + fabric + kSmall);
  const auto linear = manifest_in(run.out / "linear")["scene"]["fabric"];
  const double scale = linear["b2"].get<double>() / 1e-5;
  EXPECT_GT(scale, 1.2);
  const auto stiffnesses = linear["bending"]["stops"]["stiffnesses"];
  ASSERT_EQ(stiffnesses.size(), 2u);
  EXPECT_NEAR(stiffnesses[0].get<double>() / 2e-5, scale, kDigits);
  EXPECT_NEAR(linear["b1"].get<double>() / 4e-5, scale, kDigits) << "b2 and the stops";
}

TEST(Compare, KeepsWhatIsFinishedOfTheSameQuestion) {
  const std::string line = "compare swing --laws linear,prandtl --no-images" + kSmall;
  const FinishedRun run(line);
  const auto written = [&] { return fs::last_write_time(run.out / "linear/manifest.json"); };
  const auto first = written();
  finished(line + " --resume" + out_flag(run.out));
  EXPECT_EQ(written(), first);
  finished(line + " --resume --fabric wool-tropical" + out_flag(run.out));
  EXPECT_NE(written(), first);
}

TEST(Compare, WritesColumnsOfFabricFilesIntoItsOwnFolder) {
  const Folder folder;
  const fs::path root = folder.path(), out = root / "run" / "out";
  for (const char* side : {"p", "q"}) {
    fs::create_directories(root / side);
    fs::copy_file(find_asset("fabrics", "wool-tropical", "--fabric"), root / side / "mine.toml");
  }
  fs::create_directories(root / "run");
  {
    const InFolder here(root / "run");
    finished("compare swing --no-images --out out" + kSmall + " --law linear --fabrics ../p/mine.toml," +
             (root / "q" / "mine.toml").string());
  }
  for (const char* column : {"mine", "mine-2"}) EXPECT_TRUE(fs::exists(out / column / "manifest.json"));
  for (const char* side : {"p", "q"})
    EXPECT_EQ(std::distance(fs::directory_iterator(root / side), fs::directory_iterator()), 1) << side;
  EXPECT_EQ(std::distance(fs::directory_iterator(root), fs::directory_iterator()), 3);
}

TEST(Compare, RefusesTheSameColumnTwice) {
  const Folder folder;
  const std::string out = folder.path() / "out";
  EXPECT_EQ(refused("compare swing --laws linear,linear --out " + out + kSmall),
            "hysteron compare: linear is named twice: columns must differ\n");
  refused("compare swing --laws linear,,prandtl --out " + out + kSmall);
  EXPECT_FALSE(fs::exists(out));
}

TEST(ColumnName, OfAFileIsItsStemAndStaysInItsFolder) {
  EXPECT_EQ(column_name("prandtl"), "prandtl");
  EXPECT_EQ(column_name("linear+fabric.damping=2e-3"), "linear+fabric.damping=2e-3");
  EXPECT_EQ(column_name("/a/wool.toml"), "wool");
  EXPECT_EQ(column_name("wool.toml+mesh=../m/disc.obj"), "wool+mesh=disc");
  for (const char* text : {"..", ".", "../..", "/", "a/..", "", "a/"}) {
    const std::string name = column_name(text);
    EXPECT_EQ(name.find('/'), std::string::npos) << text;
    EXPECT_EQ(name.find("column"), 0u) << text << ": " << name;
  }
}

// A file system takes 255 bytes.
TEST(ColumnName, ThatIsTooLongIsCutAndToldApart) {
  const std::string zeros(300, '0'), law = "prandtl+air-drag=0.";
  const auto named = [&](const std::string& laws) {
    return named_variants({"swing", "", {{"law", laws}}, {}});
  };
  const auto variants = named("linear," + law + zeros + "1," + law + zeros + "2");
  ASSERT_EQ(variants.size(), 3u);
  EXPECT_EQ(variants[0].name, "linear");
  EXPECT_NE(variants[1].name, variants[2].name);
  for (const Variant& variant : variants) EXPECT_LT(variant.name.size(), 200u);
  EXPECT_TRUE(variants[1].name.starts_with(law + "000"));
  EXPECT_EQ(folder_name(variants[1].name), variants[1].name);
  EXPECT_EQ(named(law + zeros + "1,linear")[0].name, variants[1].name) << "whatever the others";
}

Variant variant(const std::string& fabric, const std::string& law) {
  return {fabric + law, {{"fabric", fabric}, {"law", law}}};
}

TEST(Variants, AreNamedAfterTheOneKeyInWhichTheyDiffer) {
  EXPECT_EQ(varied_key({variant("a", "linear"), variant("a", "prandtl")}), "law");
  EXPECT_EQ(varied_key({variant("a", "linear"), variant("b", "linear")}), "fabric");
  EXPECT_EQ(varied_key({variant("a", "linear"), variant("b", "prandtl")}), "column");
  EXPECT_EQ(varied_key({{"", {{"integrator", "bdf2"}}}, {"", {{"integrator", "implicit"}}}}), "integrator");
  Variant damped = variant("a", "linear");
  damped.flags.push_back({"fabric.damping", 1e-3});
  EXPECT_EQ(varied_key({variant("a", "linear"), damped}), "fabric.damping");
  EXPECT_EQ(varied_key({variant("a", "linear"), damped, variant("a", "prandtl")}), "column");
}

TEST(ComparisonTable, HasAColumnForEveryMetricOfAnyRow) {
  const Folder folder;
  ExperimentRun run({"compare", "hysteron compare", {}, {}}, setup_in(folder.path()).options, Json::object());
  std::vector<ChildRun> columns(2);
  columns[0].name = "linear";
  columns[1].name = "prandtl";
  columns[1].stopped = "at 1 s, crushed";
  columns[0].manifest.emplace().metrics = {{"turns", 3}, {"decay_shape", "plateau"}};
  columns[1].manifest.emplace().metrics = {{"turns", 2}, {"loss_J", 0.5}, {"set_m", NAN}};
  write_comparison_table(run, "law", columns);
  run.finish();
  EXPECT_EQ(file_content(folder.path() / "table.csv"),
            "law,turns,loss_J,set_m,stopped\nlinear,3,,,\nprandtl,2,0.5,,\"at 1 s, crushed\"\n");
  const auto metrics = metrics_of(folder.path());
  EXPECT_EQ(metrics, Json({{"linear.turns", 3},
                           {"linear.decay_shape", "plateau"},
                           {"prandtl.turns", 2},
                           {"prandtl.loss_J", 0.5}}));
}

std::string compare_refusal(const std::string& more) {
  const Folder folder;
  const std::string said = without_warnings(refused(
      "compare swing --laws linear,prandtl" + out_flag(folder.path() / "out") + kSmallWithTimes + more));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  return said;
}

TEST(Compare, ShowsTheInstantsAndTheMetricsThatItIsAskedForInTheirOrder) {
  const FinishedRun run(
      "compare swing --laws linear,prandtl --compare.times 0.1,0.035 --compare.metrics "
      "max_stretch_percent,decay_shape,bending_friction_J" +
      kSmallWithTimes);
  const std::string table = file_content(run.out / "table.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "law,max_stretch_percent,decay_shape,bending_friction_J,stopped");
  const Json metrics = run.metrics();
  EXPECT_EQ(metrics.size(), 6u) << metrics;
  EXPECT_EQ(metrics["linear.decay_shape"], "unknown");
  // Pictures are 1/30 s apart: the one at 0.033 s is the nearest to 0.035 s.
  std::vector<double> times;
  for (const ArchivedState& instant : read_archived(run.out / "sheet.hyg").cloths.at(0).instants)
    times.push_back(instant.time);
  ASSERT_EQ(times.size(), 3u) << "the first is kept beside the rows'";
  EXPECT_NEAR(times[1], 1 / 30.0, 1e-3);
  EXPECT_NEAR(times[2], 0.1, 1e-3);
  EXPECT_TRUE(fs::exists(run.out / "plot_bending_friction_J.png"));
}

// A column that has run says what it finds: the first one early on, and all of a page that is there at once.
TEST(Compare, WarnsOfAMetricThatItsFirstColumnHasNotAndRefusesItOverACompletePage) {
  const std::string line = "compare swing --laws linear,prandtl --no-images" + kSmall;
  const FinishedRun page(line);
  const std::string manifest = file_content(page.out / "manifest.json");
  const std::string said =
      refused(line + " --compare.metrics bending_friction_J,nonsense_m" + out_flag(page.out));
  EXPECT_TRUE(says(said, "compare.metrics = nonsense_m must be among "));
  EXPECT_FALSE(says(said, "warning: ")) << "nothing has run";
  EXPECT_EQ(file_content(page.out / "manifest.json"), manifest);
  EXPECT_FALSE(fs::exists(page.out / ".before"));
  const Folder elsewhere;
  EXPECT_TRUE(says(refused(line + " --compare.metrics nonsense_m" + out_flag(elsewhere.path() / "out")),
                   " has found no nonsense_m (--compare.metrics)"));
}

TEST(Compare, RefusesInstantsAfterTheEndOfTheRunBeforeItBegins) {
  EXPECT_EQ(compare_refusal(" --compare.times 0.05,0.11"),
            "hysteron compare: compare.times = 0.11 s must be in [0, 0.1] s, the time of the run "
            "(--compare.times)\n");
  EXPECT_TRUE(says(compare_refusal(" --compare.times=-0.1"), "must be >= 0"));
}

TEST(Compare, RefusesOneDumpedSceneForAllItsColumns) {
  const Folder folder;
  const std::string file = folder.file("dumped.toml");
  EXPECT_TRUE(says(refused("compare drape --quick --laws prandtl,linear --dump-scene " + file),
                   "is one file, and every column has a scene of its own"));
  EXPECT_FALSE(fs::exists(file));
}

TEST(Compare, RefusesAStiffnessThatItsMatchingWouldChange) {
  const Folder folder;
  const std::string said = refused("compare swing --laws linear+fabric.b2=1e-5,prandtl" +
                                   out_flag(folder.path() / "out") + kSmall);
  EXPECT_TRUE(says(said, "column linear+fabric.b2=1e-5: fabric.b2 = 1e-05 would be multiplied by "));
  EXPECT_TRUE(says(said, "--compare.match fabric leaves it as it is"));
}

TEST(Compare, RefusesOneValueBesideAListOfTheSameKey) {
  for (const char* flags :
       {"--laws linear,prandtl --law dahl", "--fabrics cotton-broad,wool-tropical --fabric polyester-faille",
        "--integrators bdf2,implicit --integrator tr-bdf2"}) {
    const Outcome outcome = program("compare swing --no-images " + std::string(flags) + kSmall);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_TRUE(says(outcome.err, "of which each column has its own")) << outcome.err;
  }
}

TEST(Compare, NamesTheColumnThatIsWrong) {
  const Folder folder;
  const std::string out = out_flag(folder.path() / "out") + kSmall;
  EXPECT_TRUE(says(refused("compare swing --laws linear,prandle" + out), "prandle"));
  refused("compare" + out);
  EXPECT_TRUE(says(refused("compare cantilever --laws linear,prandtl" + out),
                   "cantilever cannot be compared: compare takes "));
  refused("compare swing --laws linear --compare.to narain" + out);
}

TEST(Compare, SaysWhyAColumnStopped) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  const std::string scene = folder.write("struck.toml", R"([[obstacle]]
kind = "sphere"
center = [0.06, 0.025, 0]
radius = 0.02
from = 0.04
)");
  const Outcome outcome =
      program("compare swing --scene " + scene + " --laws linear" + out_flag(out) + kSmall);
  EXPECT_TRUE(says(file_content(out / "table.csv"), "an obstacle appears where the cloth is"))
      << outcome.out << outcome.err << file_content(out / "table.csv");
  EXPECT_TRUE(says(outcome.err, "warning: linear: ")) << "though it is quiet";
}

// Fabrics under the one law that the scene names, or the program's own.
TEST(Compare, SetsFabricsOfASceneSideBySide) {
  const Folder folder;
  for (const std::string law : {"", "law = \"dahl\"\n"}) {
    const std::string scene =
        folder.write("held.toml", law +
                                      "triangles = 60\nstep = 0.01\nseconds = 0.05\n[cloth]\nlength = 0.2\n"
                                      "[[pin]]\nlow = [-1, -1, -1]\nhigh = [0.01, 1, 1]\n");
    const FinishedRun run("compare " + scene +
                          " --fabrics cotton-broad,wool-tropical --no-images --device cpu --quiet");
    EXPECT_EQ(manifest_in(run.out / "wool-tropical")["law"], law.empty() ? "prandtl" : "dahl");
    const auto page = run.manifest()["scene"]["columns"];
    ASSERT_EQ(page.size(), 2u);
    for (const auto& one : page) EXPECT_EQ(one["stiffness_times"], 1) << "of one law nothing is matched";
  }
}

// Laws are matched by the scene that runs: parameters of its file, and those that only one column has.
TEST(Compare, MatchesTheLawThatItRuns) {
  const Folder folder;
  const auto scene = [&](const std::string& parameters) {
    return folder.write("held.toml", "law = \"bridson\"\ntriangles = 20\nstep = 0.01\nseconds = 0.02\n" +
                                         parameters + "[cloth]\nlength = 0.1\n");
  };
  const auto stiffness = [&](const std::string& parameters, const std::string& flags) {
    return first_stiffness(
        FinishedRun("compare " + scene(parameters) + " --no-images --device cpu --quiet --laws " + flags));
  };
  const std::string both = "bridson,spring";
  const double in_file = stiffness("[param]\nheight = 0.05\n", both),
               as_flag = stiffness("", both + " --param height=0.05");
  EXPECT_EQ(in_file, as_flag);
  EXPECT_NE(in_file, stiffness("", both)) << "the parameter matters";
  const double weaker = stiffness("", "obrien+param=yield=20,prandtl"),
               stronger = stiffness("", "obrien,prandtl");
  EXPECT_GT(std::abs(weaker / stronger - 1), 0.01) << "obrien yields elsewhere without its parameter";
}

// Two laws beside each other are both matched to prandtl of their fabric, as a page that has it beside them
// would match them: neither is as the order of columns has it.
TEST(Compare, MatchesColumnsToPrandtlWhateverTheirOrder) {
  const Folder folder;
  const std::string scene =
      folder.write("held.toml", "triangles = 20\nstep = 0.01\nseconds = 0.02\n[cloth]\nlength = 0.1\n");
  const auto page = [&](const std::string& laws) {
    const FinishedRun run("compare " + scene + " --no-images --device cpu --laws " + laws);
    const Json manifest = run.manifest();
    std::map<std::string, double> times;
    for (const auto& column : manifest["scene"]["columns"])
      times[column["name"].get<std::string>()] = column["stiffness_times"].get<double>();
    EXPECT_EQ(manifest["scene"]["matched_to"], "prandtl") << laws;
    EXPECT_TRUE(says(run.outcome.err, "Matched to prandtl")) << run.outcome.err;
    return times;
  };
  const auto with_prandtl = page("linear,dahl,prandtl"), two = page("linear,dahl"),
             turned = page("dahl,linear");
  EXPECT_EQ(two, turned);
  for (const char* law : {"linear", "dahl"}) EXPECT_EQ(two.at(law), with_prandtl.at(law)) << law;
  EXPECT_EQ(with_prandtl.at("prandtl"), 1);
}

TEST(Compare, LeavesLawsTheFabricsNumbersIfToldSo) {
  EXPECT_EQ(first_stiffness(FinishedRun(
                "compare swing --laws linear,prandtl --no-images --compare.match fabric" + kSmall)),
            1);
}

}  // namespace
}  // namespace hysteron::experiments
