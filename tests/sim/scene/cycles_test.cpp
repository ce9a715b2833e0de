// Phases that are gone through several times: times, motions, what is refused.
#include "sim/scene/cycles.h"

#include <nlohmann/json.hpp>

#include "sim/scene/keys.h"
#include "sim/scene/motion.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

// Phases take 0.5 s before the cycles, 1 s each, 0.25 s after them.
const std::string kCyclicPhases =
    "[[phase]]\nname = \"hang\"\nseconds = 0.5\n[[phase]]\nname = \"bend\"\nseconds = 0.75\nrepeat = true\n"
    "[[phase]]\nname = \"rest\"\nseconds = 0.25\nrepeat = true\n[[phase]]\nname = \"spread\"\nseconds = "
    "0.25\n";
const std::string kMovingBall = "[[obstacle]]\nkind = \"sphere\"\n";
// It goes away in the cycle and comes back, and rises at the end.
const std::string kBackAndForth =
    "keys = [{time = \"bend\"}, {time = \"bend + 0.25\", position = [0.1, 0, 0]}, {time = \"rest\"}, "
    "{time = \"spread\"}, {time = \"spread + 0.25\", position = [0, 0, 1]}]\n";

Scene scene_with(int cycles, const std::string& text = "") {
  Scene scene = scene_of(text + kCyclicPhases);
  apply_flags(scene, {{"cycles", cycles}});
  return scene;
}

TEST(Cycles, GoThroughTheirTimesAgain) {
  const Cycles cycles{0.5, 1, 3};
  EXPECT_EQ(cycles.said(0.25), 0.25);
  EXPECT_EQ(cycles.said(0.75), 0.75);
  EXPECT_EQ(cycles.said(1.75), 0.75);
  EXPECT_EQ(cycles.said(3.25), 1.25);
  EXPECT_EQ(cycles.said(3.75), 1.75) << "behind them";
  EXPECT_EQ(cycles.first(0.75), 0.75);
  EXPECT_EQ(cycles.first(1.75), 3.75);
  EXPECT_EQ(cycles.end_of(2), 2.5);
  for (const auto& [time, number] : {std::pair(0.25, 0), {0.5, 1}, {1.25, 1}, {1.5, 2}, {3.25, 3}, {3.5, 0}})
    EXPECT_EQ(cycles.at(time), number) << time;
  EXPECT_EQ(Cycles{}.said(7), 7);
}

TEST(Cycles, MakeASceneLongerUnlessItSaysHowLongItLasts) {
  EXPECT_EQ(scene_with(1).seconds, 1.75);
  EXPECT_EQ(scene_with(3).seconds, 3.75);
  EXPECT_EQ(scene_of("cycles = 3\n" + kCyclicPhases).seconds, 3.75);
  EXPECT_EQ(scene_with(3, "seconds = 2\n").seconds, 2);
}

TEST(Cycles, AreNamedWithTheirPhases) {
  const Scene scene = scene_with(3);
  for (const auto& [time, name] : {std::pair(0.25, "hang"),
                                   {0.75, "bend, cycle 1"},
                                   {1.75, "bend, cycle 2"},
                                   {3.3, "rest, cycle 3"},
                                   {3.6, "spread"},
                                   {9.0, "spread"}})
    EXPECT_EQ(scene.phase_at(time), name) << time;
  EXPECT_EQ(scene_with(1).phase_at(0.75), "bend");
}

TEST(Cycles, ThatASceneEndsWithHaveItsEnd) {
  Scene scene = scene_with(2);
  EXPECT_EQ(cycle_at(scene, 2.5), 0) << "the spread begins";
  scene.phase.pop_back();
  EXPECT_EQ(cycle_at(scene, 2.5), 2);
}

TEST(Cycles, RepeatWhatMovesAndDelayWhatComesAfterThem) {
  const Scene once = scene_with(1, kMovingBall + kBackAndForth),
              scene = scene_with(3, kMovingBall + kBackAndForth);
  check_scene(scene);
  const Motion &first = once.obstacle[0].motion, &motion = scene.obstacle[0].motion;
  for (const double time : {0.25, 0.625, 0.75, 1.0, 1.5}) {
    const Eigen::Vector3d expected = state_at(first, time).position;
    for (const double later : {0.0, 1.0, 2.0}) {
      if (later > 0 && time < 0.5) continue;
      EXPECT_LT((state_at(motion, time + later).position - expected).norm(), 1e-15) << time << " + " << later;
    }
  }
  EXPECT_EQ(state_at(motion, 3.75).position.z(), 1);
  EXPECT_EQ(state_at(motion, 3.5).position.z(), 0);
}

TEST(Cycles, MayEndAfterAWholeTurn) {
  EXPECT_EQ(test::refusal([] {
              check_scene(scene_with(
                  2, kMovingBall + "keys = [{time = \"bend\"}, {time = \"spread\", angle = 360}]\n"));
            }),
            test::kAccepted);
}

TEST(Cycles, AreReadBackFromAManifest) {
  const Scene scene = scene_with(3, kMovingBall + kBackAndForth);
  Scene again = default_scene();
  apply_recorded_scene(again, to_json(scene), "manifest.json");
  EXPECT_EQ(to_json(again), to_json(scene));
  EXPECT_EQ(again.seconds, 3.75);
  EXPECT_EQ(again.obstacle[0].motion.cycles.count, 3);
  apply_flags(again, {{"cycles", 2}});
  EXPECT_EQ(again.seconds, 2.75);
  EXPECT_EQ(again.obstacle[0].motion.cycles.count, 2);
}

TEST(Cycles, AreRefusedWhereTheyMakeNoSense) {
  const std::string nearby = "[[pin]]\nselect = \"nearest\"\n";
  const std::pair<std::string, const char*> kCases[] = {
      {"cycles = 0\n" + kCyclicPhases, "cycles = 0 must be in [1, 1000]"},
      {"cycles = 2\n", "must be 1 without [[phase]] tables that have repeat = true"},
      {kCyclicPhases + "[[phase]]\nname = \"more\"\nrepeat = true\n",
       "phases that repeat must follow one another, and phase[3] before it does not"},
      {"cycles = 2\n" + kMovingBall + "keys = [{time = 0}, {time = \"rest\", position = [0, 0, 0.1]}]\n" +
           kCyclicPhases,
       "obstacle[0].keys (file.toml:2) must come back from 0.5 s to 1.5 s"},
      {"cycles = 2\n" + kMovingBall + "keys = [{time = \"bend\"}, {time = \"rest\", scale = 0.5}]\n" +
           kCyclicPhases,
       "they end 0 m, 0 degree and 50 % of the size beside where they begin"},
      {"cycles = 2\n" + nearby + "until = \"rest\"\n" + kCyclicPhases,
       "must be <= 0.5 s, where the first of cycles = 2 (file.toml:1) begins: it happens once"},
      {"cycles = 2\n" + nearby + "from = \"spread\"\n" + kCyclicPhases, "pin[0].from = 1.5 s"},
      {"cycles = 2\n[[command]]\ntime = \"rest\"\n" + kCyclicPhases, "command[0].time = 1.25 s"}};
  for (const auto& [text, message] : kCases) {
    const TextFile file(text);
    std::string said = test::refusal([&] {
      Scene scene = default_scene();
      apply_scene_file(scene, file.path());
      check_scene(scene);
    });
    for (std::size_t at; (at = said.find(file.path())) != said.npos;)
      said.replace(at, file.path().size(), "file.toml");
    EXPECT_TRUE(test::says(said, message)) << text;
  }
}

TEST(Cycles, OfOneLeaveMotionsThatDoNotComeBackAlone) {
  EXPECT_EQ(test::refusal([] {
              check_scene(scene_with(
                  1, kMovingBall + "keys = [{time = 0}, {time = \"rest\", position = [0, 0, 1]}]\n"));
            }),
            test::kAccepted);
}

}  // namespace
}  // namespace hysteron
