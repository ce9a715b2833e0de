// Crumpling by its own command: what stays under a law with hysteresis and does not under an elastic one.
#include "render/image.h"
#include "sim/base/csv.h"
#include "tests/experiments/program.h"
#include "tests/render/test_scene.h"

namespace hysteron::experiments {
namespace {

// Returns the path of a scene beside this file, or of a shipped one.
std::string scene_named(const std::string& name) {
  const auto file = fs::path(__FILE__).parent_path() / "scenes" / (name + ".toml");
  return fs::exists(file) ? file.string() : "crumple-" + name;
}

TEST(Crumple, LeavesWrinklesInClothThatRubsAndNoneInElasticCloth) {
  const FinishedRun run("crumple --scene " + scene_named("tube") +
                        " --law linear,prandtl --triangles 300 --no-images --quiet");
  const auto elastic = manifest_in(run.out / "linear"), hysteretic = manifest_in(run.out / "prandtl");
  for (const auto& manifest : {elastic, hysteretic}) {
    EXPECT_EQ(manifest["metrics"]["intersections"], 0);
    EXPECT_EQ(manifest["complete"], true);
    EXPECT_LT(manifest["metrics"]["energy_remainder_relative"], 1e-6);
    EXPECT_NEAR(manifest["seconds_simulated"].get<double>(), 1.5, 1e-9);
  }
  EXPECT_LT(elastic["metrics"]["residual_curvature_rms_per_m"], 1e-9);
  EXPECT_GT(hysteretic["metrics"]["residual_curvature_rms_per_m"], 5);
  EXPECT_GT(hysteretic["metrics"]["ridge_length_m"], 0.05);
  EXPECT_GT(hysteretic["metrics"]["tilted_triangles_percent"], 1);
  EXPECT_TRUE(says(hysteretic["warnings"].dump(), "coarse for their fold"));
  EXPECT_EQ(read_table(run.out / "table.csv").rows.size(), 2u);
}

// The right end of a strip is led over the left one, which is held, and 2 cm beyond it.
constexpr const char* kLedThroughItself = R"(
integrator = "implicit"
step = 0.005
seconds = 0.3
triangles = 100
self-contact = true
newton-residual = 1e-3
newton-velocity = 1e-4
[cloth]
shape = "strip"
length = 0.1
width = 0.03
[[pin]]
low = [-1, -1, -1]
high = [0.02, 1, 1]
[[pin]]
low = [0.08, -1, -1]
high = [1, 1, 1]
keys = [{time = 0, position = [0, 0, 0]}, {time = 0.1, position = [-0.04, 0, 0.04]},
        {time = 0.15, position = [-0.08, 0, 0.02]}, {time = 0.25, position = [-0.08, 0, -0.02]}]
)";

TEST(Crumple, ComesToItsEndWhereRigidPinsPullClothThroughClothAndTellsHowFarTheyLagged) {
  const Folder folder;
  const FinishedRun run("crumple --scene " + folder.write("led.toml", kLedThroughItself) +
                        " --threads 1 --no-images");
  const auto metrics = run.metrics();
  EXPECT_GT(metrics["barred_hand_steps_count"], 0);
  EXPECT_NEAR(metrics["hand_lag_m"].get<double>(), 0.02, 3 * Fabric{}.thickness);
  EXPECT_EQ(metrics["intersections"], 0);
  EXPECT_EQ(metrics.value("unbalanced_steps_count", 0), 0);
  EXPECT_TRUE(says(run.outcome.err, "cloth barred the way of rigid pins"));
}

// Nothing holds this square, which falls by 1/2 g t^2 = 0.8 m.
constexpr const char* kFalling = R"(
integrator = "implicit"
step = 0.02
seconds = 0.4
mesh = "unionjack"
triangles = 64
[cloth]
shape = "square"
length = 0.1
rotation = [90, 0, 0]
)";

TEST(Crumple, PicturesClothThatFallsToTheEnd) {
  const Folder folder;
  const FinishedRun run("crumple --scene " + folder.write("falling.toml", kFalling) +
                        " --size 160x120 --fps 5 --look silhouette --plain --threads 1 --quiet");
  const auto is_dark = [](const std::uint8_t* pixel) { return pixel[1] < 128; };
  for (const char* frame : {"0000.png", "0001.png", "0002.png"})
    EXPECT_GT(render::test::count_pixels(render::read_png(run.out / "frames" / frame), is_dark), 20) << frame;
  EXPECT_FALSE(says(run.outcome.err, "cut off"));
}

// The camera of one law looks elsewhere; of what its run says the error counts, not the warning before it.
TEST(Crumple, WarnsOfALawThatIsMissingOnItsSheet) {
  const Folder folder;
  const auto out = folder.path() / "run";
  const Outcome outcome =
      program("crumple --scene " + folder.write("falling.toml", kFalling) +
              " --law 'linear,prandtl+camera.target=9 9 9+camera.distance=1' --size 160x120 --fps 5 "
              "--threads 1 --quiet" +
              out_flag(out));
  EXPECT_TRUE(says(outcome.err, "is missing on the page's sheet and plots: "));
  EXPECT_TRUE(says(outcome.err, "shows no cloth at t = 0.000 s"));
  EXPECT_TRUE(fs::exists(out / "sheet.png"));
}

// The beginning of each shipped scene and of those beside this file, on a small mesh.
class CrumpledScene : public testing::TestWithParam<const char*> {};

TEST_P(CrumpledScene, BeginsInBalanceAndFreeOfCrossingsUnderLawsWithAndWithoutMemory) {
  const FinishedRun run("crumple --scene " + scene_named(GetParam()) +
                        " --law linear,prandtl --triangles 300 --seconds 0.06 --no-images --quiet");
  for (const char* law : {"linear", "prandtl"}) {
    const auto metrics = metrics_of(run.out / law);
    EXPECT_EQ(metrics["intersections"], 0) << law;
    EXPECT_EQ(metrics["unbalanced_steps_count"], 0) << law;
    EXPECT_EQ(metrics.value("deep_contact_steps_count", 0), 0) << law;
    EXPECT_LT(metrics["energy_remainder_relative"], 1e-9) << law;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CrumpledScene,
                         testing::Values("sphere", "tube", "fist", "table", "fall", "knot", "wring", "press",
                                         "ring"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace hysteron::experiments
