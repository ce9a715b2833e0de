// Phases: times by name, in scene files and alone.
#include "sim/scene/cycles.h"
#include "sim/scene/scene_reader.h"

#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

const std::vector<Phase> kPhases = {{"crush", 0.5}, {"hold", 0.25}, {"hang", 1}};

TEST(Phases, FollowOneAnother) {
  EXPECT_EQ(phase_start(kPhases, "crush"), 0);
  EXPECT_EQ(phase_start(kPhases, "hang"), 0.75);
  EXPECT_EQ(phase_start(kPhases, "spread"), -1);
  Scene scene;
  scene.phase = kPhases;
  EXPECT_EQ(phases_end(scene), 1.75);
  EXPECT_EQ(scene.phase_at(0), "crush");
  EXPECT_EQ(scene.phase_at(0.5), "hold");
  EXPECT_EQ(scene.phase_at(9), "hang");
  EXPECT_EQ(Scene{}.phase_at(1), "");
}

TEST(Phases, AreTimesWithAndWithoutAnOffset) {
  EXPECT_EQ(phase_time(kPhases, "hold", "here"), 0.5);
  EXPECT_EQ(phase_time(kPhases, "hang + 0.25", "here"), 1);
  EXPECT_EQ(phase_time(kPhases, "hang-0.25", "here"), 0.5);
}

TEST(Phases, ThatAreUnknownOrMistypedAreRefused) {
  for (const char* text : {"spread", "hold + soon", "hold +", "1.5"})
    EXPECT_TRUE(test::says(test::refusal([&] { phase_time(kPhases, text, "s.toml:3"); }), "s.toml:3"))
        << text;
}

TEST(Phases, SetTheTimesOfASceneFile) {
  const Scene scene = scene_of(
      "[[pin]]\nselect = \"nearest\"\nfrom = \"open\"\nuntil = \"open + 0.5\"\n"
      "keys = [{time = \"open\"}, {time = \"open + 0.25\", position = [0, 0, 1]}]\n"
      "[[phase]]\nname = \"crush\"\nseconds = 0.5\n[[phase]]\nname = \"open\"\nseconds = 1.5\n");
  EXPECT_EQ(scene.seconds, 2);
  ASSERT_EQ(scene.pin.size(), 1u);
  EXPECT_EQ(scene.pin[0].from, 0.5);
  EXPECT_EQ(scene.pin[0].until, 1);
  EXPECT_EQ(scene.pin[0].motion.keys[1].time, 0.75);
}

TEST(Phases, LeaveASceneThatSaysHowLongItLastsAlone) {
  EXPECT_EQ(scene_of("seconds = 0.75\n[[phase]]\nname = \"crush\"\nseconds = 0.5\n").seconds, 0.75);
}

}  // namespace
}  // namespace hysteron
