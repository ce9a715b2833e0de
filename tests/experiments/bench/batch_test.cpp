#include "experiments/bench/batch.h"

#include <gtest/gtest.h>

#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

TEST(TimesTogether, HaveTheStatesOfOneAtATimeAndCountStepsOfAllCloths) {
  Scene scene = default_scene();
  scene.mesh = "aligned";
  scene.cloth.length = 0.1;
  scene.triangles = 18;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  const BatchChoice choice{{3, 6}, 2, 2 * scene.step, 5};
  int heard = 0;
  const auto rows = times_together(scene, choice, [&](const Metrics&) { ++heard; });
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(heard, 3);
  EXPECT_EQ(rows[0].number("cloths"), 1);
  EXPECT_EQ(rows[0].number("times_one_at_a_time"), 1);
  const double equal[] = {4, 3, 4};  // of the four that ran alone
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double cloths = rows[k].number("cloths"), seconds = 1e-3 * rows[k].number("ms_per_step");
    EXPECT_EQ(rows[k].number("equal_states"), equal[k]);
    EXPECT_NEAR(rows[k].number("cloth_steps_per_second"), cloths / seconds, 1e-9 * cloths / seconds);
    EXPECT_EQ(rows[k]["device"].text().substr(0, 3), "cpu");
  }
}

}  // namespace
}  // namespace hysteron::experiments
