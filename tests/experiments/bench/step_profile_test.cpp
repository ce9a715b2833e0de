#include "experiments/bench/step_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/cloth.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr int kSteps = 3;

// A square that falls freely.
StepProfile falling() {
  Scene scene = default_scene();
  scene.cloth.length = 0.1;
  scene.triangles = 80;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 240;
  return profile_of_steps(*make_simulation(scene, make_cloth(scene)), kSteps);
}

// Calls, times and shares of the kernels add up to those of the step.
TEST(StepProfile, KernelsAddUpToTheStep) {
  constexpr double kRounding = 1e-9;
  const StepProfile profile = falling();
  double calls = 0, us = 0, share = 0;
  for (const Metrics& row : profile.kernels) {
    EXPECT_LE(row.number("us_per_step"), profile.kernels[0].number("us_per_step"));
    EXPECT_NEAR(row.number("us_per_step"), row.number("us_per_call") * row.number("calls_per_step"),
                kRounding * row.number("us_per_step"));
    calls += row.number("calls_per_step");
    us += row.number("us_per_step");
    share += row.number("share_percent");
  }
  EXPECT_NEAR(calls, profile.step.number("launches_per_step"), kRounding * calls);
  EXPECT_NEAR(1e-3 * us, profile.step.number("ms_per_step_in_kernels"), kRounding * us);
  EXPECT_NEAR(share, 100, kRounding * 100);
  EXPECT_LE(profile.step.number("ms_per_step_in_kernels"), profile.step.number("ms_per_step_profiled"));
}

// Bytes over time over what a copy reaches, where the loop states its bytes.
TEST(StepProfile, SetsBytesBesideACopy) {
  constexpr double kRounding = 1e-9;
  const StepProfile profile = falling();
  const double bandwidth = 1e9 * profile.step.number("copy_bandwidth_GB_per_s");
  EXPECT_GT(bandwidth, 0);
  int stated = 0;
  for (const Metrics& row : profile.kernels) {
    if (!row["bytes_per_call"].is_number()) continue;
    ++stated;
    EXPECT_GT(row.number("bytes_per_call"), 0);
    const double fraction = row.number("bytes_per_call") / (1e-6 * row.number("us_per_call")) / bandwidth;
    EXPECT_NEAR(row.number("fraction_of_copy_bandwidth"), fraction, kRounding * fraction);
  }
  EXPECT_GT(stated, 8);
}

}  // namespace
}  // namespace hysteron::experiments
