// These tests check warnings of a run that goes on.
#include "experiments/workbench/session/run_warnings.h"

#include <fmt/core.h>

#include "tests/experiments/program.h"
#include "tests/sim/contact/two_sheets.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron::experiments {
namespace {

using test::Trial;

void expect_one(const std::vector<std::string>& texts, const std::string& part) {
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_TRUE(says(texts[0], part));
}

TEST(Start, WithLayersThatPressIsSaidWithTheirEnergy) {
  const Trial pressed = test::two_sheets(0.11 * Fabric{}.thickness, 60);
  const auto simulation = pressed.simulation();
  const double stored = simulation->ledger().contact;
  EXPECT_GT(stored, 0);
  expect_one(warnings_at_start(pressed.scene, pressed.cloth, *simulation),
             fmt::format("contact stores {:.2g} J at the start", stored));
  const Trial kissing = test::two_sheets(Fabric{}.thickness, 60);
  EXPECT_TRUE(warnings_at_start(kissing.scene, kissing.cloth, *kissing.simulation()).empty());
}

bool one_says(const std::vector<std::string>& texts, const std::string& part) {
  return std::ranges::any_of(texts, [&](const std::string& text) { return text.find(part) != text.npos; });
}

TEST(Start, WithLimitsThatTheWeightMeetsAtOnceIsSaid) {
  Trial trial(test::hanging_square(60));
  trial.scene.integrator = Integrator::implicit;
  trial.scene.step = 0.01;
  const auto warnings = [&] { return warnings_at_start(trial.scene, trial.cloth, *trial.simulation()); };
  EXPECT_FALSE(one_says(warnings(), "cloth may not move at all"));
  trial.scene.newton_velocity = 0.01;  // gravity gives 0.098 m/s
  EXPECT_TRUE(
      one_says(warnings(), "is more than a twentieth of the 0.0981 m/s that gravity gives in a step"));
  trial.scene.newton_residual = 0.3;
  EXPECT_TRUE(one_says(warnings(), "leaves so much of the load out of balance"));
}

TEST(Start, WithALoadThatTheEndCutsOffIsSaid) {
  Trial trial(test::hanging_square(60));
  trial.scene.integrator = Integrator::quasi_static;
  trial.scene.seconds = 1;
  const auto warnings = [&](double ramp, double unload) {
    trial.scene.ramp = ramp, trial.scene.unload = unload;
    return warnings_at_start(trial.scene, trial.cloth, *trial.simulation());
  };
  EXPECT_FALSE(one_says(warnings(1, 0), "of the weight"));
  EXPECT_FALSE(one_says(warnings(0.5, 0.5), "of the weight"));
  EXPECT_TRUE(
      one_says(warnings(2, 0), "ends with 50 % of the weight: ramp = 2 s (default) is how long it grows"));
  EXPECT_TRUE(one_says(warnings(0.5, 2), "ends with 75 % of the weight"));
}

TEST(Start, WithInstantsWithinAStepIsSaid) {
  Trial trial(test::hanging_square(60));
  trial.scene.step = 0.01, trial.scene.seconds = 1;
  trial.scene.pin.resize(1);
  trial.scene.pin[0].until = 0.1001, trial.scene.origin["pin[0].until"] = "a test";
  const auto warnings = [&] { return warnings_at_start(trial.scene, trial.cloth, *trial.simulation()); };
  EXPECT_TRUE(
      one_says(warnings(),
               "pin[0].until = 0.1001 s (a test) lies within a step of 0.01 s: it counts from the next "
               "one on, at 0.11 s"));
  trial.scene.pin[0].until = 0.11;
  EXPECT_FALSE(one_says(warnings(), "lies within a step"));
}

TEST(End, WithClothStretchedAsNoneIsSaysByHowMuch) {
  const Trial trial(test::hanging_square(60));
  const auto& x = trial.cloth.start;
  expect_one(warnings_at_end(trial.scene, trial.cloth, x, 65.57), "stretched by up to 6557 %");
  EXPECT_TRUE(warnings_at_end(trial.scene, trial.cloth, x, 0.3).empty());
}

// A pin tears at one side of a sheet of 10 cm.
constexpr const char* kTorn = R"(
seconds = 0.3
triangles = 100
[cloth]
length = 0.1
[[pin]]
low = [0, 0, -1]
high = [0.011, 0.1, 1]
[[pin]]
low = [0.089, 0, -1]
high = [0.1, 0.1, 1]
keys = [{time = 0}, {time = 0.2, position = [5, 0, 0]}]
)";

TEST(End, WithClothTornApartIsSaidWithQuietToo) {
  const TextFile scene(kTorn);
  const FinishedRun run("run " + scene.path() + " --no-images --quiet");
  EXPECT_TRUE(says(run.outcome.err, "warning: the cloth was stretched by up to "));
  EXPECT_TRUE(says(file_content(run.out / "manifest.json"), "\"the cloth was stretched by up to "));
}

TEST(Drawing, FarFromTheOriginIsSaidToBeRounded) {
  Scene scene = test::free_square(60);
  EXPECT_EQ(drawing_text(scene, Trial(scene).cloth), "");
  scene.cloth.position.x() = 1e4;
  const std::string text = drawing_text(scene, Trial(scene).cloth);
  EXPECT_TRUE(says(text, fmt::format("round positions to {:.2g} m", 1e4 * std::pow(2.0, -23))));
}

// A float has 24 bits: its distance from the next is up to 2^-23 of it.
TEST(End, FarFromTheStartSaysWhatSinglePrecisionIsRoundedTo) {
  Scene scene = test::free_square(60);
  scene.precision = Precision::fp32;
  const Trial trial(scene);
  test::Positions far = trial.cloth.start;
  for (Eigen::Vector3d& x : far) x.z() -= 1000;
  expect_one(warnings_at_end(trial.scene, trial.cloth, far, 0),
             fmt::format("rounded to {:.2g} m", 1000 * std::pow(2.0, -23)));
  scene.precision = Precision::fp64;
  EXPECT_TRUE(warnings_at_end(scene, trial.cloth, far, 0).empty());
}

TEST(Triangles, ThatAreATenthMoreOrFewerThanAskedForAreCounted) {
  EXPECT_EQ(triangle_count_warning(100, "--triangles", 110), "");
  EXPECT_EQ(triangle_count_warning(100, "--triangles", 90), "");
  for (const int triangles : {89, 111})
    EXPECT_TRUE(
        says(triangle_count_warning(100, "--triangles", triangles),
             "triangles = 100 (--triangles) is not what the mesh has: whole rows and columns of its kind "
             "make " +
                 std::to_string(triangles)));
}

// A strip's columns across the crease are at most a thickness wide, whatever is asked for.
TEST(Triangles, OfACreaseAreSaidWhereItsColumnsTakeMore) {
  const std::string crease =
      "crease --crease.fold pleat --crease.recovery 0.02 --device cpu --no-images --quiet --triangles ";
  EXPECT_TRUE(
      says(FinishedRun(crease + "60").outcome.err, "warning: triangles = 60 (--triangles) is not what"));
  EXPECT_FALSE(says(FinishedRun(crease + "136").outcome.err, "triangles = 136"));
}

}  // namespace
}  // namespace hysteron::experiments
