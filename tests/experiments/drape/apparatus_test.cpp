// The apparatus of drape tests: sizes of the standards, and how pedestal, disc and plate move.
#include "experiments/drape/apparatus.h"

#include <gtest/gtest.h>

#include "sim/scene/motion.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

Scene with_apparatus(const DrapeChoice& choice) {
  Scene scene = default_scene();
  add_apparatus(scene, choice, {specimen_radius(choice.standard), {0, 0, 0}});
  return scene;
}

TEST(DrapeStandards, HaveTheirSizes) {
  EXPECT_EQ(specimen_radius("iso9073"), 0.15);
  EXPECT_EQ(drape_by_standard("iso9073").disc, 0.09);
  EXPECT_EQ(drape_by_standard("iso9073").release, "lowered");
  EXPECT_EQ(specimen_radius("jis"), 0.127);
  EXPECT_EQ(drape_by_standard("jis").disc, 0.0635);
  EXPECT_EQ(drape_by_standard("jis").release, "shaken");
  EXPECT_EQ(drape_by_standard("jis").wait, 60);
}

// Three times up and down once the plate has gone, then at rest; the disc goes with the pedestal, so that the
// specimen stays pressed as it was.
TEST(ShakenDrape, GoesUpAndDownAndStops) {
  const DrapeChoice choice = drape_by_standard("jis");
  const Scene scene = with_apparatus(choice);
  ASSERT_EQ(scene.obstacle.size(), 3u);
  const auto height = [&](int obstacle, double time) {
    return placement(scene.obstacle[obstacle].motion, time).translation.z();
  };
  for (int stroke = 0; stroke < 3; ++stroke) {
    const double begin = choice.lowered() + stroke * choice.period;
    EXPECT_NEAR(height(0, begin), 0, 1e-12);
    EXPECT_NEAR(height(0, begin + choice.period / 2), choice.stroke, 1e-12);
  }
  EXPECT_NEAR(height(0, choice.released()), 0, 1e-12);
  EXPECT_NEAR(height(0, choice.released() + 1), 0, 1e-12);
  EXPECT_NEAR(choice.released(), choice.lowered() + 3 * choice.period, 1e-12);
  for (double time = 0; time < choice.released() + 0.5; time += 0.01)
    EXPECT_EQ(height(0, time), height(1, time)) << "the clamp never opens, at " << time;
  EXPECT_NEAR(height(2, choice.lowered()), -choice.plate, 1e-12);
  EXPECT_EQ(scene.obstacle[2].until, choice.lowered());
}

TEST(LoweredDrape, DoesNotShake) {
  for (const char* release : {"lowered", "relifted", "dropped"}) {
    DrapeChoice choice;
    choice.release = release;
    const Scene scene = with_apparatus(choice);
    EXPECT_TRUE(scene.obstacle[0].motion.keys.empty()) << release;
    EXPECT_TRUE(scene.obstacle[1].motion.keys.empty()) << release;
    EXPECT_EQ(choice.released(), choice.lowered()) << release;
  }
}

}  // namespace
}  // namespace hysteron::experiments
