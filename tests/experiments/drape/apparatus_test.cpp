// The apparatus of drape tests: sizes of the standards, and how pedestal, disc and plate move.
#include "experiments/drape/apparatus.h"

#include <cmath>
#include <numbers>

#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/csv.h"
#include "sim/scene/motion.h"
#include "sim/scene/scene_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Scene with_apparatus(const DrapeParams& choice) {
  Scene scene = default_scene();
  add_apparatus(scene, choice, {specimen_radius(choice.standard), {0, 0, 0}});
  return scene;
}

// Metrics of a drape of 300 triangles, unless flags say otherwise; its files lie in out/.
Metrics quick_drape(const Folder& folder, const std::vector<Flag>& further) {
  std::vector<Flag> flags = {{"triangles", 300}, {"threads", 1}, {"device", "cpu"}, {"quick", true}};
  flags.insert(flags.end(), further.begin(), further.end());
  EXPECT_EQ(run_into(folder.path() / "out", "drape", std::move(flags)), 0);
  return read_manifest(folder.path() / "out/manifest.json").metrics;
}

// Three times up by 3 cm and down once the plate has gone, which sinks for 3 s, then at rest; the disc goes
// with the pedestal, so that the specimen stays pressed as it was.
TEST(ShakenDrape, GoesUpAndDownThreeTimesAndStops) {
  constexpr double kStroke = 0.03, kSunk = 3, kRounding = 1e-12, kInstant = 0.01;  // [m], [s], [m], [s]
  const Scene scene = with_apparatus(drape_by_standard(DrapeStandard::jis));
  ASSERT_EQ(scene.obstacle.size(), 3u);
  const auto height = [&](int obstacle, double time) {
    return placement(scene.obstacle[obstacle].motion, time).translation.z();
  };
  int tops = 0;
  double last_top = 0, end = 0;  // [s]
  for (double time = 0; time < 10; time += kInstant) {
    const double here = height(0, time);
    EXPECT_EQ(here, height(1, time)) << "the clamp never opens, at " << time;
    EXPECT_GE(here, 0) << time;
    EXPECT_LE(here, kStroke + kRounding) << time;
    if (time < kSunk) {
      EXPECT_EQ(here, 0) << "the plate carries the ring, at " << time;
    }
    if (here > kRounding) end = time;
    if (here > 0.9 * kStroke && (tops == 0 || time > last_top + 0.2)) ++tops, last_top = time;
    if (here > 0.9 * kStroke) last_top = time;
  }
  EXPECT_EQ(tops, 3);
  EXPECT_NEAR(end, kSunk + 3 * 0.5, 2 * kInstant) << "half a second each";
  EXPECT_LT(height(2, kSunk), -0.1) << "deeper than the ring is wide, 63.5 mm";
  EXPECT_EQ(scene.obstacle[2].until, kSunk);
}

// A published drape is one of its own tester: of that standard, with its sizes.
TEST(PublishedDrape, StandsBesideDrapesOfItsOwnTesterOnly) {
  const DrapeParams iso = drape_by_standard(DrapeStandard::iso9073),
                    jis = drape_by_standard(DrapeStandard::jis);
  Fabric fabric;
  EXPECT_EQ(other_tester_message(fabric, iso, 0.15), "") << "none is published";
  fabric.published["drape-coefficient"] = {82.9, "%", {}, DrapeStandard::jis};
  const PublishedNumber& number = fabric.published["drape-coefficient"];
  EXPECT_TRUE(is_own_tester(number, jis, 0.127));
  EXPECT_EQ(other_tester_message(fabric, jis, 0.127), "");
  EXPECT_FALSE(is_own_tester(number, iso, 0.15));
  EXPECT_TRUE(says(other_tester_message(fabric, iso, 0.15), "--drape.standard jis"));
  DrapeParams dropped = jis, beside = jis;
  DrapeParams shaken_once = jis, read_at_once = jis;
  dropped.release = DrapeRelease::dropped, beside.offset = 0.02;
  shaken_once.shakes = 1, read_at_once.wait = 0;
  for (const DrapeParams& other : {dropped, beside, shaken_once, read_at_once}) {
    EXPECT_FALSE(is_own_tester(number, other, 0.127));
    EXPECT_TRUE(says(other_tester_message(fabric, other, 0.127), "another way: --drape.standard jis"));
  }
  EXPECT_FALSE(is_own_tester(number, jis, 0.15)) << "another specimen";
  EXPECT_TRUE(says(other_tester_message(fabric, jis, 0.15), "without drape.disc and cloth.radius"));
  fabric.published["drape-coefficient"].tester.reset();
  EXPECT_FALSE(is_own_tester(number, iso, 0.15));
  EXPECT_TRUE(says(other_tester_message(fabric, iso, 0.15), "names no tester"));
}

TEST(PublishedDrape, IsNoResultOfADrapeOnAnotherTester) {
  const Folder folder;
  const std::vector<Flag> small = {{"triangles", 60}, {"seconds", 0.8}};
  const Metrics default_metrics = quick_drape(folder, small);
  EXPECT_FALSE(default_metrics.contains("published_drape_coefficient_percent"));
  EXPECT_FALSE(default_metrics.contains("published_node_count"));
  EXPECT_TRUE(says(default_metrics["published_drape"].text(), "--drape.standard jis"));
  std::vector<Flag> shaken = small;
  shaken.push_back({"drape.standard", "jis"});
  const Metrics jis_metrics = quick_drape(folder, shaken);
  EXPECT_EQ(jis_metrics["published_drape_coefficient_percent"].number(), 82.9);
  EXPECT_FALSE(jis_metrics.contains("published_drape"));
  shaken.push_back({"fabric.k0", 12});
  const Metrics changed = quick_drape(folder, shaken);
  EXPECT_EQ(changed["published_drape_coefficient_percent"].number(), 82.9);
  EXPECT_EQ(changed["published_drape"].text(), "is of cotton-broad without --fabric.k0");
  shaken.push_back({"gravity", Numbers{0, 0, -5}});
  const Metrics lighter = quick_drape(folder, shaken);
  EXPECT_FALSE(lighter.contains("published_drape_coefficient_percent"));
  EXPECT_TRUE(says(lighter["published_drape"].text(), "stands upright on earth"));
}

TEST(Drape, RefusesGravityThatPullsTheSpecimenOffAndWarnsOfATilt) {
  Scene scene = default_scene();
  EXPECT_EQ(tilt_warning(scene), "");
  scene.gravity = {0, 1, -9.81};
  EXPECT_TRUE(says(tilt_warning(scene), "pulls 5.8 degree away from straight down"));
  for (const Eigen::Vector3d& g : {Eigen::Vector3d(0, 0, 9.81), Eigen::Vector3d(9.81, 0, 0),
                                   Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 0, -5)}) {
    scene.gravity = g;
    EXPECT_TRUE(says(test::refusal([&] { tilt_warning(scene); }), "does not pull the specimen onto"))
        << g.transpose();
  }
}

TEST(LoweredDrape, DoesNotShake) {
  for (const DrapeRelease release : {DrapeRelease::lowered, DrapeRelease::relifted, DrapeRelease::dropped}) {
    DrapeParams choice;
    choice.release = release;
    const Scene scene = with_apparatus(choice);
    EXPECT_TRUE(scene.obstacle[0].motion.keys.empty()) << enum_name(release);
    EXPECT_TRUE(scene.obstacle[1].motion.keys.empty()) << enum_name(release);
  }
}

// A card of 200 g/m^2.  As a strip, its free ring ends with a slope of density g L^3/(6 B), of which the
// shadow sees the square: 0.08 % of the coefficient where L is the ring's 63.5 mm and a triangle's side of 20
// mm, since vertices under the disc's rim are few.
TEST(ShakenDrape, OfStiffPaperStaysFlat) {
  constexpr double kSag = 0.1, kShaken = 0.5;  // of the coefficient, at rest and in motion [%]
  const Folder folder;
  const Metrics metrics = quick_drape(folder, {{"drape.standard", "jis"},
                                               {"drape.wait", 0},
                                               {"law", "linear"},
                                               {"fabric.b1", 5e-3},
                                               {"fabric.b2", 5e-3},
                                               {"fabric.density", 0.2},
                                               {"fabric.thickness", 2.5e-4}});
  const Table series =
      read_csv(folder.path() / "out/metrics.csv", {"time [s]", "drape_coefficient [%]"}, {}, "test");
  ASSERT_EQ(series.numbers("time [s]").front(), 0);
  const std::vector<double> percents = series.numbers("drape_coefficient [%]");
  const double flat = percents.front();  // of the polygon that the rim is
  EXPECT_NEAR(metrics.number("drape_coefficient_percent"), flat, kSag);
  for (const double percent : percents) EXPECT_NEAR(percent, flat, kShaken) << "while it shakes";
  EXPECT_EQ(metrics.number("node_count"), 0);
  EXPECT_TRUE(metrics["settled"].is(true));
}

// The same folds under every method are what makes equilibria comparable.
TEST(DroppedDrape, HangsInTheFoldsThatWereSeeded) {
  for (const int folds : {6, 7}) {
    const Folder folder;
    EXPECT_EQ(quick_drape(folder, {{"drape.release", "dropped"}, {"drape.folds", folds}, {"triangles", 600}})
                  .number("node_count"),
              folds);
  }
}

// Vertices around the specimen's rim, around the middle of its free ring, and around a circle under the disc.
TEST(SeededFolds, AreWavesOfTheRimAloneAndNeedARingThatNothingCarries) {
  constexpr int kAround = 64, kFolds = 4;
  constexpr double kRadii[] = {0.15, 0.12, 0.07};  // of a specimen of 0.15 m on a disc of 0.09 m
  DrapeParams choice;
  choice.folds = kFolds;
  std::vector<Eigen::Vector3d> start;
  for (const double radius : kRadii)
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      start.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  EXPECT_THROW(seed_folds(start, choice, 0.15), Error);
  choice.release = DrapeRelease::dropped;
  seed_folds(start, choice, 0.15);
  double highest[3] = {};
  int tops = 0;
  for (int i = 0; i < 3 * kAround; ++i) {
    highest[i / kAround] = std::max(highest[i / kAround], std::abs(start[i].z()));
    const double before = start[(i + kAround - 1) % kAround].z(), after = start[(i + 1) % kAround].z();
    if (i < kAround) tops += start[i].z() > before && start[i].z() > after;
  }
  EXPECT_EQ(tops, kFolds);
  EXPECT_NEAR(highest[0], 2e-3, 1e-12) << "more would stretch the rim, less would let folds merge";
  EXPECT_GT(highest[1], 0);
  EXPECT_LT(highest[1], highest[0] / 2);
  EXPECT_EQ(highest[2], 0);
}

}  // namespace
}  // namespace hysteron::experiments
