#include "experiments/bench/thread_scaling.h"

#include <gtest/gtest.h>

#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

std::vector<ThreadProfile> profiles() {
  Scene scene = default_scene();
  scene.cloth.length = 0.1;
  scene.triangles = 5000;  // loops of some thousand elements are shared
  scene.device = DeviceChoice::cpu;
  const Cloth cloth = make_cloth(scene);
  std::vector<ThreadProfile> all;
  for (const int threads : {1, 2}) all.push_back(profile_with(threads, scene, cloth, 1));
  return all;
}

TEST(ThreadScaling, ChangesTimesAndNothingElse) {
  const std::vector<ThreadProfile> of = profiles();
  EXPECT_EQ(of[0].state_hash, of[1].state_hash);
  EXPECT_NE(of[0].device, of[1].device);
  for (const char* count : {"launches_per_step", "solver_iterations_per_step", "bytes_per_step"})
    EXPECT_EQ(of[0].profile.step.number(count), of[1].profile.step.number(count)) << count;
  EXPECT_EQ(of[0].profile.kernels.size(), of[1].profile.kernels.size());
}

TEST(ThreadScaling, IsDrawnBesideAnEvenShare) {
  constexpr double kRounding = 1e-12;
  const render::Plot plot = thread_plot(profiles());
  ASSERT_EQ(plot.series.size(), 12u) << "the step and five kernels";
  for (std::size_t s = 0; s < plot.series.size(); s += 2) {
    const render::Series &measured = plot.series[s], &even = plot.series[s + 1];
    EXPECT_EQ(measured.color, even.color);
    EXPECT_EQ(measured.x, (std::vector<double>{1, 2}));
    EXPECT_EQ(even.y[0], measured.y[0]);
    EXPECT_NEAR(even.y[1], measured.y[0] / 2, kRounding * measured.y[0]);
  }
}

TEST(ThreadScaling, AsksForNoMoreThanTheMachineHas) {
  EXPECT_EQ(threads_within({1, 2, 4, 8, 16}, 6), (std::vector<int>{1, 2, 4}));
  EXPECT_TRUE(threads_within({4}, 2).empty());
}

}  // namespace
}  // namespace hysteron::experiments
