
#include <fmt/core.h>

#include <cmath>

#include "experiments/workbench/pictures/drawing.h"
#include "render/compare.h"
#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

class Scenes : public testing::Test {
 protected:
  // Metrics of a run of this scene.
  Json recorded_metrics(const std::string& scene, const std::string& flags = "--no-images") {
    run(0, scene, flags);
    return metrics_of(out());
  }
  Outcome run(int exit_code, const std::string& scene, const std::string& flags) {
    return ended(exit_code, "run " + folder_.write("mine.toml", scene) +
                                " --quiet --threads 1 --device cpu " + flags + out_flag(out()));
  }
  fs::path out() const { return folder_.path() / "out"; }

  Folder folder_;
};

const std::string kSquare = R"(
mesh = "unionjack"
triangles = 64
step = 0.01
seconds = 0.1
[cloth]
shape = "square"
length = 0.2
)";

TEST_F(Scenes, ThatAreSmallAlreadyAreNoSmallerByQuick) {
  const std::string few = run(0, kSquare, "--no-images --quick").err;
  EXPECT_TRUE(says(few, "warning: --quick simulates no less: triangles = 64", "is kept"));
  std::string larger = kSquare;
  larger.replace(larger.find("= 64"), 4, "= 600");
  const std::string many = run(0, larger, "--no-images --quick --seconds 0.01").err;
  EXPECT_EQ(many.find("--quick"), many.npos) << many;
}

TEST_F(Scenes, FallFreelyAsImplicitEulerHasIt) {
  constexpr double kRounding = 1e-9;
  const Json metrics = recorded_metrics(kSquare + R"([[metric]]
name = "corner"
kind = "height"
point = [0.2, 0.2, 0]
[[metric]]
name = "side"
point = [0, 0, 0]
to = [0.2, 0, 0]
[[metric]]
name = "flat"
kind = "angle"
high = [0.1, 0.2, 0]
other-low = [0.1, 0, 0]
[[metric]]
name = "kept"
kind = "residual-curvature"
)");
  const int n = 10;
  EXPECT_NEAR(metrics["corner_m"], -9.81 * 0.01 * 0.01 * n * (n + 1) / 2, kRounding);
  EXPECT_NEAR(metrics["side_m"], 0.2, kRounding);
  EXPECT_NEAR(metrics["flat_deg"], 0, 1e-5);  // the angle of two directions is known to the root of rounding
  EXPECT_NEAR(metrics["kept_per_m"], 0, kRounding);
}

TEST_F(Scenes, AreTooCoarseForRidgesOfAQuarterOfTheirEdges) {
  const auto said = [&](const char* cutoff) {
    return run(0, kSquare + "[[metric]]\nname = \"ridges\"\nkind = \"ridge-height\"\ncutoff = " + cutoff,
               "--no-images --seconds 0.01")
        .err;
  };
  EXPECT_TRUE(
      says(said("0.1"), "metric ridges: edges of 0.0", " m are more than a quarter of cutoff = 0.1 m"));
  EXPECT_FALSE(says(said("0.2"), "metric ridges"));
}

// Implicit Euler falls by g h^2 n (n + 1)/2 in n steps, 5 of them before the instant to compare with,
// whatever instants are recorded.
TEST_F(Scenes, AreComparedWithAnInstantThatIsNoFrame) {
  constexpr double kRounding = 1e-9, kCells = 0.3;
  const std::string scene = kSquare + R"(rotation = [90, 0, 0]
[[phase]]
name = "first"
seconds = 0.05
[[phase]]
name = "last"
seconds = 0.05
[[metric]]
name = "fallen"
kind = "height"
from = "last"
[[metric]]
name = "outline"
kind = "silhouette"
from = "last"
direction = [0, 1, 0]
[[metric]]
name = "late"
kind = "height"
from = 0.1
)";
  const double fallen = 9.81 * 0.01 * 0.01 * (10 * 11 - 5 * 6) / 2;
  for (const char* rate : {"3", "100"}) {
    const Outcome outcome = run(0, scene, "--no-images --fps " + std::string(rate));
    const Json metrics = metrics_of(out());
    EXPECT_NEAR(metrics["fallen_m"], -fallen, kRounding);
    EXPECT_NEAR(metrics["outline_percent"], 100 * 2 * fallen / (0.2 + fallen), kCells);
    EXPECT_FALSE(metrics.contains("late_m"));
    EXPECT_TRUE(
        says(outcome.err, "metric late: it is not measured, since from = 0.1 s is not before the end"));
  }
  const std::vector<double> column = read_table(out() / "metrics.csv").numbers("fallen [m]");
  ASSERT_EQ(column.size(), 11u);
  for (int n = 0; n <= 10; ++n)
    EXPECT_NEAR(column[n], n < 5 ? 0 : -9.81 * 0.01 * 0.01 * (n * (n + 1) - 5 * 6) / 2, kRounding) << n;
}

// A pin lifts a whole square and lowers it again, three times.
const std::string kLifted = kSquare + R"([[phase]]
name = "hold"
seconds = 0.03
[[phase]]
name = "lift"
seconds = 0.04
repeat = true
[[pin]]
low = [-1, -1, -1]
high = [1, 1, 1]
keys = [{time = "lift"}, {time = "lift + 0.02", position = [0, 0, 0.01]}, {time = "lift + 0.04"}]
[[metric]]
name = "corner"
kind = "height"
from = "lift + 0.02"
)";

TEST_F(Scenes, AreGoneThroughInCyclesAndSayWhatEachAdds) {
  constexpr double kRounding = 1e-12;
  std::string scene = kLifted;
  scene.erase(scene.find("seconds = 0.1\n"), 14);
  run(0, scene, "--no-images --cycles 3 --fps 100");
  const Json manifest = manifest_in(out()), metrics = metrics_of(out());
  EXPECT_NEAR(manifest["seconds_simulated"], 0.15, kRounding);
  EXPECT_EQ(manifest["scene"]["cycles"], 3);
  for (const char* name : {"corner_m", "corner_cycle_1_m", "corner_cycle_2_m", "corner_cycle_3_m"})
    EXPECT_NEAR(metrics[name], -0.01, kRounding) << name;
  EXPECT_EQ(manifest["asked_metrics"],
            Json({"corner_m", "corner_cycle_1_m", "corner_cycle_2_m", "corner_cycle_3_m"}));
  const Table series = read_table(out() / "metrics.csv"), cycles = read_table(out() / "cycles.csv");
  EXPECT_EQ(series.numbers("cycle"), (std::vector<double>{0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 3}));
  EXPECT_EQ(cycles.head, (std::vector<std::string>{"cycle", "time [s]", "corner [m]"}));
  ASSERT_EQ(cycles.rows.size(), 3u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(cycles.number(c, "time [s]"), 0.03 + 0.04 * (c + 1), kRounding);
    const std::vector<double> height = series.numbers("corner [m]");
    EXPECT_NEAR(height[5 + 4 * c], 0, kRounding) << "the top";
  }
}

TEST_F(Scenes, ThatAreCutShortSayWhatTheirCyclesSaid) {
  std::string scene = kLifted;
  scene.replace(scene.find("seconds = 0.1\n"), 14, "seconds = 0.1\ncycles = 3\n");
  const Outcome outcome = run(0, scene, "--no-images");
  EXPECT_TRUE(says(outcome.err, "its phases take 0.15 s"));
  const Json metrics = metrics_of(out());
  EXPECT_TRUE(metrics.contains("corner_cycle_1_m"));
  EXPECT_FALSE(metrics.contains("corner_cycle_2_m"));
}

TEST_F(Scenes, HangFromAHandThatCarriesTheirWeight) {
  constexpr double kBalanced = 2e-6;  // newton-residual, of the load
  const std::string scene = R"(integrator = "quasi-static"
newton-residual = 1e-8
)" + kSquare + R"(rotation = [90, 0, 0]
[[pin]]
low = [0, 0.19, -1]
high = [0.2, 0.2, 1]
[[metric]]
name = "weight"
kind = "force"
direction = [0, 0, 1]
[[metric]]
name = "size"
kind = "force"
)";
  const Json metrics = recorded_metrics(scene + "[fabric]\ndensity = 0.25\n");
  const double weight = 0.25 * 0.2 * 0.2 * 9.81;
  EXPECT_NEAR(metrics["weight_N"], weight, kBalanced * weight);
  EXPECT_NEAR(metrics["size_N"], weight, kBalanced * weight);
}

TEST_F(Scenes, TurnAPartByTheAngleOfItsHand) {
  constexpr double kRounding = 1e-9;
  const Json metrics = recorded_metrics(R"(gravity = [0, 0, 0]
)" + kSquare + R"([[pin]]
low = [0, 0, -1]
high = [0.05, 0.2, 1]
[[pin]]
low = [0.15, 0, -1]
high = [0.2, 0.2, 1]
axis = [0, 1, 0]
center = [0.1, 0.1, 0]
keys = [{time = 0}, {time = 0.1, angle = 40}]
[[metric]]
name = "fold"
kind = "angle"
high = [0.03, 0.2, 1]
other-low = [0.17, 0, -1]
)");
  EXPECT_NEAR(metrics["fold_deg"], 40, kRounding * 40);
}

// An OBJ of a strip of 0.2 m by 0.04 m whose halves have cells of these lengths [m], its second half rolled
// to a curvature of 20/m: flat, or as it starts.
std::string half_rolled(double first, double second, bool flat) {
  constexpr double kHalf = 0.1, kRadius = 0.05, kWidth = 0.04;
  constexpr int kRows = 4;
  std::vector<double> along;
  for (int i = 0; i < std::lround(kHalf / first); ++i) along.push_back(i * first);
  for (int i = 0; i <= std::lround(kHalf / second); ++i) along.push_back(kHalf + i * second);
  std::string text;
  for (const double s : along)
    for (int j = 0; j <= kRows; ++j) {
      const double angle = flat || s < kHalf ? 0 : (s - kHalf) / kRadius;
      const double x = angle > 0 ? kHalf + kRadius * std::sin(angle) : s;
      text +=
          fmt::format("v {:.12g} {:.12g} {:.12g}\n", x, kWidth * j / kRows, kRadius * (1 - std::cos(angle)));
    }
  for (std::size_t i = 0; i + 1 < along.size(); ++i)
    for (int j = 1; j <= kRows; ++j) {
      const auto a = static_cast<int>(i) * (kRows + 1) + j, b = a + kRows + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
    }
  return text;
}

// Half of the cloth keeps a curvature: how many triangles it has there is no matter of the mean.
TEST_F(Scenes, KeepAMeanCurvatureThatDoesNotDependOnWhereTheMeshIsFine) {
  constexpr double kCells = 0.05;  // of the mean, by the cells where the curvature begins and at free edges
  const auto kept = [&](double first, double second) {
    folder_.write("flat.obj", half_rolled(first, second, true));
    folder_.write("rolled.obj", half_rolled(first, second, false));
    const Json metrics = recorded_metrics(R"(gravity = [0, 0, 0]
step = 1e-4
seconds = 1e-4
[cloth]
shape = "file"
file = "flat.obj"
start = "rolled.obj"
[[pin]]
low = [-1, -1, -1]
high = [1, 1, 1]
[[metric]]
name = "kept"
kind = "residual-curvature"
)");
    return std::pair<double, double>(metrics["kept_per_m"], metrics["residual_curvature_rms_per_m"]);
  };
  const auto even = kept(0.01, 0.01), graded = kept(0.02, 0.005), other = kept(0.005, 0.02);
  EXPECT_GT(even.first, 1) << "friction holds a curvature";
  for (const auto& [requested, recorded] : {graded, other}) {
    EXPECT_NEAR(requested / even.first, 1, kCells);
    EXPECT_NEAR(recorded / even.second, 1, kCells);
  }
}

TEST_F(Scenes, ArePicturedWithTheirPhases) {
  const std::string phases = R"([[phase]]
name = "hang"
seconds = 0.05
[[phase]]
name = "swing"
seconds = 0.05
)";
  recorded_metrics(kSquare + phases, "--fps 20 --size 160x120");
  const Json manifest = manifest_in(out());
  ASSERT_EQ(manifest["frames"]["moments"].size(), 3u);
  EXPECT_EQ(manifest["frames"]["moments"][0]["phase"], "hang");
  EXPECT_EQ(manifest["frames"]["moments"][2]["phase"], "swing");
  EXPECT_TRUE(fs::exists(out() / "sheet.png"));
}

TEST_F(Scenes, FailWhereAPictureShowsNoCloth) {
  const Outcome outcome =
      run(3, kSquare, "--fps 10 --size 160x120 --camera.box '0 0 5 0.2 0.2 5.2' --camera.direction '0 -1 0'");
  EXPECT_TRUE(says(outcome.err, "frames/0000.png shows no cloth at t = 0.000 s"));
  EXPECT_EQ(manifest_in(out())["complete"], false);
}

// A quarter of the square is framed from above.
TEST_F(Scenes, WarnWhereTheBorderOfThePicturesCutsOffCloth) {
  const Outcome outcome = run(
      0, kSquare, "--fps 20 --size 160x120 --camera.box '0 0 -0.01 0.1 0.1 0.01' --camera.direction '0 0 1'");
  const std::string warning = "from t = 0.000 s on (frames/0000.png) the cloth is cut off at the border";
  EXPECT_TRUE(says(outcome.err, "warning: " + warning));
  const Json warnings = manifest_in(out())["warnings"];
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [&](const Json& text) { return text.get<std::string>().starts_with(warning); }),
            1);
}

// The program finds only env, which starts the columns.
TEST_F(Scenes, AreComparedInOneFrameAndWarnOfPlotsAndFilmsThatCannotBeMade) {
  const std::string scene =
      folder_.write("mine.toml", kSquare + "[[metric]]\nname = \"side\"\nto = [0.2, 0, 0]\n");
  const std::string path = std::getenv("PATH");
  fs::create_symlink("/usr/bin/env", folder_.path() / "env");
  setenv("PATH", folder_.path().c_str(), 1);
  const Outcome outcome =
      program("compare " + scene +
              " --laws linear,prandtl --compare.video mp4 --quiet --threads 1 --device cpu --size 160x120 "
              "--fps 10" +
              out_flag(out()));
  setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json linear = manifest_in(out() / "linear");
  const Json prandtl = manifest_in(out() / "prandtl");
  EXPECT_TRUE(says(outcome.out, "linear                        side "));
  EXPECT_EQ(linear["experiment"], "run");
  EXPECT_EQ(linear["options"]["camera"]["box"].size(), 6u);
  EXPECT_EQ(linear["options"]["camera"], prandtl["options"]["camera"]);
  EXPECT_TRUE(prandtl["metrics"].contains("side_m"));
  const std::string film = "compare.video: there is no film.mp4: ffmpeg is not installed";
  EXPECT_TRUE(says(outcome.err, "warning: " + film + "\n"));
  EXPECT_TRUE(says(outcome.err, "warning: the plot plot_side is missing: "));
  const Json warnings = manifest_in(out())["warnings"];
  EXPECT_NE(std::find(warnings.begin(), warnings.end(), film), warnings.end()) << warnings;
  EXPECT_TRUE(fs::exists(out() / "sheet.png"));
}

// Two points of a cloth that falls freely stay as far apart as they are.
TEST_F(Scenes, SayAtTheEndWhatTheyWereAskedFor) {
  const Outcome outcome = run(0, kSquare + "[[metric]]\nname = \"side\"\nto = [0.2, 0, 0]\n", "--no-images");
  EXPECT_TRUE(says(outcome.out, "  side                          0.2 m\n"));
  EXPECT_EQ(manifest_in(out())["asked_metrics"], Json({"side_m"}));
}

const std::string kCornerHeight = R"([[metric]]
name = "corner"
kind = "height"
point = [0.2, 0.2, 0]
)";

// A free fall by implicit Euler with the step h ends at -g T (T + h)/2, wherever the vertices are.
TEST_F(Scenes, HaveTheErrorsOfTheirOwnMetrics) {
  constexpr double kStep = 0.01, kSeconds = 0.1, kRounding = 1e-9;
  const Json metrics = recorded_metrics(kSquare + kCornerHeight, "--no-images --errors --errors.draws 1");
  EXPECT_NEAR(metrics["corner_m_step_error"], 9.81 * kSeconds * kStep / 4, kRounding);
  EXPECT_NEAR(metrics["corner_m_mesh_error"], 0, kRounding);
  EXPECT_NEAR(metrics["corner_m_draw_error"], 0, kRounding);
}

TEST_F(Scenes, WithoutMetricsHaveNoErrors) {
  const Outcome outcome = run(2, kSquare, "--no-images --errors");
  EXPECT_TRUE(says(outcome.err, "has no [[metric]] whose errors could be measured"));
}

TEST_F(Scenes, WarnOfPinsCommandsAndPhasesThatDoOtherThanTheySeemTo) {
  const Outcome outcome = run(0, "law = \"grinspun-edit\"\n" + kSquare + R"(
[[phase]]
name = "only"
seconds = 0.3
[[pin]]
select = "nearest"
point = [0, 15, 0]
[[pin]]
high = [0.01, 1, 1]
keys = [{time = 0.2, position = [0, 0, 0.05]}, {time = 0.4, position = [0, 0, 0.1]}]
home = 0.5
[[obstacle]]
kind = "sphere"
center = [0, 0, -5]
height = 0.3
[[metric]]
name = "h"
kind = "height"
point = [0.1, 0.1, 0]
to = [0.2, 0, 0]
[[command]]
kind = "iron"
low = [5, 5, 5]
high = [6, 6, 6]
)",
                              "--no-images");
  EXPECT_TRUE(
      says(outcome.err, "[[pin]] 1 holds the vertex that is nearest to its point, which lies 14.8 m"));
  EXPECT_TRUE(says(outcome.err, "[[pin]] 1 holds nothing at the start: later pins take all"));
  EXPECT_TRUE(says(outcome.err, "[[pin]] 2 jumps within the first step to where its first key is (0.05 m"));
  EXPECT_TRUE(says(outcome.err, "[[pin]] 2: home = 0.5 changes nothing: from > 0 reads it"));
  EXPECT_TRUE(
      says(outcome.err, "[[obstacle]] 1: height = 0.3 changes nothing: a cylinder, capsule or torus reads"));
  EXPECT_TRUE(says(outcome.err, "[[metric]] 1: to = [0.2,0.0,0.0] changes nothing: a distance reads it"));
  EXPECT_TRUE(says(outcome.err, "[[command]] 1 acts on nothing"));
  EXPECT_TRUE(says(outcome.err, "its phases take 0.3 s"));
}

TEST_F(Scenes, AreNamedOnce) {
  for (const char* line :
       {"run hanging-square --scene towel-on-rail", "run hanging-square --scene nosuch.toml",
        "compare hanging-square --scene towel-on-rail --laws linear,prandtl"})
    EXPECT_TRUE(says(refused(line), "takes one scene, and both hanging-square and --scene ")) << line;
}

TEST_F(Scenes, WarnOfStepsThatWereTakenOutOfBalance) {
  const std::string fall = "swing --quick --triangles 60 --seconds 0.05 --no-images --device cpu";
  EXPECT_TRUE(says(FinishedRun(fall + " --newton-iterations 1").outcome.err,
                   "steps were taken with forces out of balance: newton-iterations = 1 was not enough"));
  EXPECT_FALSE(says(FinishedRun(fall).outcome.err, "out of balance"));
}

TEST_F(Scenes, RefuseInOneLineWhatCannotBeMeasured) {
  const std::pair<const char*, const char*> kCases[] = {
      {"name = \"a b\"", "metric.name = \"a b\" must be small letters"},
      {"name = \"time\"", "a column of this name already"},
      {"name = \"a\"\nknid = \"height\"", "unknown key metric.knid"},
      {"name = \"a\"\nkind = \"heigth\"", "did you mean height?"},
      {"name = \"a\"", "the same vertex is nearest"},
      {"name = \"residual_curvature_rms\"\nkind = \"residual-curvature\"",
       "every run has a result residual_curvature_rms_per_m of its own"},
      {"name = \"a\"\nkind = \"height\"\npoint = [9, 0, 0]",
       "point lies 8.8 m beside the flat cloth, whose nearest vertex is at 0.2, 0, 0 m"},
      {"name = \"a\"\nkind = \"angle\"\nlow = [9, 9, 9]", "no element of the cloth"},
      {"name = \"a\"\nkind = \"silhouette\"\ndirection = [0, 0, 1]",
       "needs from, the instant to compare with"},
      {"name = \"a\"\nkind = \"silhouette\"\nfrom = 0", "needs the direction that it is seen along"},
      {"name = \"a\"\nkind = \"height\"\nfrom = \"bend\"",
       "must be a number of seconds or begin with a phase"},
      {"name = \"ridge_length\"\nkind = \"ridge-height\"", "a column of this name already"},
      {"name = \"a\"\nkind = \"force\"", "hand = 1 must be <= 0"}};
  for (const auto& [metric, message] : kCases) {
    const Outcome outcome = run(2, kSquare + "[[metric]]\n" + metric + "\n", "--no-images");
    EXPECT_TRUE(says(outcome.err, message));
    const std::string said = without_warnings(outcome.err);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(says(said, "mine.toml:")) << outcome.err;
  }
}

TEST(Camera, StandsAtItsDistanceFromTheTarget) {
  Options options;
  options.camera_direction = {0, -2, 0};
  options.camera_target = {0.1, 0.2, 0.3};
  options.camera_distance = 1.5;
  const render::Camera camera = framed_camera(options, {{0, 0, 0}, {1, 1, 1}});
  EXPECT_LT((camera.eye() - Eigen::Vector3f(0.1f, -1.3f, 0.3f)).norm(), 1e-6);
  EXPECT_LT((camera.forward() - Eigen::Vector3f(0, 1, 0)).norm(), 1e-6);
}

TEST(Camera, KeepsABoxWholeAroundItsTarget) {
  Options options;
  const render::Box box{{0, 0, 0}, {1, 1, 1}};
  options.camera_target = {0.5, 0.5, 0.5};
  EXPECT_EQ(framed_camera(options, box).eye(), framed_camera(Options(), box).eye());
  options.camera_target = {0.5, 0.5, 0};
  EXPECT_EQ(framed_camera(options, box).eye(), framed_camera(Options(), {{0, 0, -1}, {1, 1, 1}}).eye());
  options.camera_target.clear();
  options.camera_box = {0, 0, -1, 1, 1, 1};
  EXPECT_EQ(framed_camera(options, box).eye(), framed_camera(Options(), {{0, 0, -1}, {1, 1, 1}}).eye());
}

TEST_F(Scenes, AreDrawnWithFewerSamplesAsADraft) {
  const auto picture_bytes = [&](const std::string& quality) {
    run(0, kSquare, "--fps 10 --size 64x48 --quality " + quality);
    const render::Image picture = render::read_png(out() / "frames" / "0001.png");
    fs::remove_all(out());
    return picture;
  };
  const auto difference = render::compare(picture_bytes("final"), picture_bytes("draft"));
  EXPECT_GT(difference.mean_abs, 0);
  EXPECT_GT(difference.psnr_db, 40);  // measured 47.6
}

TEST(Camera, RefusesPlacesOfTheWrongSize) {
  Options options;
  options.camera_target = {1, 2};
  EXPECT_THROW(check_options(options), Error);
  options.camera_target.clear();
  options.camera_box = {0, 0, 0, 1, 0, 1};
  EXPECT_THROW(check_options(options), Error);
}

}  // namespace
}  // namespace hysteron::experiments
