// How often a step turns to its device: launches, waits and allocations as counts, which no machine's speed
// changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/device/device_counts.h"
#include "tests/sim/device/on_each_device.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

constexpr int kSteps = 6;

struct CountedStep {
  DeviceCounts counts;
  long solver, newton;  // iterations
};

CountedStep counted_step(Simulation& simulation) {
  const Diagnostics solved = simulation.counts();
  const DeviceCounts before = device_counts;
  simulation.advance(1);
  simulation.wait();
  return {{device_counts.loops - before.loops, device_counts.synchronizations - before.synchronizations,
           device_counts.allocations - before.allocations},
          simulation.counts().linear - solved.linear,
          simulation.counts().newton - solved.newton};
}

// The square hangs by two corners, without an obstacle or self-contact.
std::vector<CountedStep> recorded_steps(const char* integrator, const char* device) {
  Scene scene = test::hanging_square();
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.device = value_named<DeviceChoice>(device);
  scene.solver_tolerance = 1e-4;
  if (scene.is_implicit()) scene.step = 5e-3;
  const auto simulation = test::Trial(scene).simulation();
  std::vector<CountedStep> steps;
  for (int i = 0; i < kSteps; ++i) steps.push_back(counted_step(*simulation));
  return steps;
}

// A GPU repeats the iterations of a solve by itself, which is one launch, and the host asks once for their
// number.
class DeviceCountsOfAStep : public test::OnEachDevice {};
INSTANTIATE_TEST_SUITE_P(Devices, DeviceCountsOfAStep, testing::Values("cpu", "cuda"), test::CaseName());

TEST_P(DeviceCountsOfAStep, ExplicitStepsAreAllTheSame) {
  const auto steps = recorded_steps("explicit", GetParam());
  EXPECT_GT(steps[0].counts.loops, 0);
  for (int i = 1; i < kSteps; ++i) {
    EXPECT_EQ(steps[i].counts.loops, steps[0].counts.loops) << "step " << i;
    EXPECT_LE(steps[i].counts.synchronizations, 3) << "the wait, whether all is finite, the clock of stages";
    EXPECT_EQ(steps[i].counts.allocations, 0) << "step " << i;
  }
}

TEST_P(DeviceCountsOfAStep, SemiImplicitStepsTakeAtMostThreeLoopsAnIterationAndFourteen) {
  constexpr long kOwn = 14, kIteration = 3;
  const auto steps = recorded_steps("semi-implicit", GetParam());
  for (int i = 1; i < kSteps; ++i) {
    EXPECT_GT(steps[i].solver, 10);
    EXPECT_LE(steps[i].counts.loops, kOwn + (on_gpu() ? 1 : kIteration * steps[i].solver)) << "step " << i;
    EXPECT_LE(steps[i].counts.synchronizations, 4) << "step " << i;
    EXPECT_EQ(steps[i].counts.allocations, 0) << "step " << i;
  }
}

// Each Newton iteration linearises, solves and tries once; the host waits for the solver's end and for the
// potential, which brings the correction's size along, and as often again where a try is repeated.  A step
// waits for the potential of three guesses, for what tells whether all is finite, and for the test itself.
// ProfileOfSteps bounds the launches without those of the linear solver.
TEST_P(DeviceCountsOfAStep, ImplicitStepsAreBoundedByTheirIterations) {
  constexpr long kOwn = 60, kNewton = 60, kIteration = 10, kWaits = 7, kNewtonWaits = 4;
  constexpr long kCaptured = 2;  // with the membrane's softening and without
  const auto steps = recorded_steps("implicit", GetParam());
  for (int i = 1; i < kSteps; ++i) {
    const long sent = on_gpu() ? kCaptured : steps[i].solver;
    EXPECT_GE(steps[i].newton, 1);
    EXPECT_LE(steps[i].counts.loops, kOwn + kNewton * steps[i].newton + kIteration * sent) << "step " << i;
    EXPECT_LE(steps[i].counts.synchronizations, kWaits + kNewtonWaits * steps[i].newton) << "step " << i;
    EXPECT_EQ(steps[i].counts.allocations, 0) << "step " << i;
  }
}

}  // namespace
}  // namespace hysteron
