#include "experiments/bench/step_profile.h"

#include <gtest/gtest.h>

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
  double calls = 0, us = 0, stage_share = 0;
  for (const Metrics& row : profile.kernels) {
    EXPECT_LE(row.number("us_per_step"), profile.kernels[0].number("us_per_step"));
    EXPECT_NEAR(row.number("us_per_step"), row.number("us_per_call") * row.number("calls_per_step"),
                kRounding * row.number("us_per_step"));
    calls += row.number("calls_per_step");
    us += row.number("us_per_step");
    stage_share += row.number("share_percent");
  }
  EXPECT_NEAR(calls, profile.step.number("launches_per_step"), kRounding * calls);
  EXPECT_NEAR(1e-3 * us, profile.step.number("ms_per_step_in_kernels"), kRounding * us);
  EXPECT_NEAR(stage_share, 100, kRounding * 100);
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

// Returns a square that hangs from two corners.
Scene hanging(Integrator integrator, int triangles) {
  Scene scene = default_scene();
  scene.mesh = "aligned";
  scene.cloth.length = 0.1;
  scene.triangles = triangles;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.integrator = integrator;
  scene.linear_solver = Preconditioning::multigrid;
  scene.step = 1e-3;
  scene.pin.resize(2);
  for (Pin& pin : scene.pin) pin.select = PinSelection::nearest;
  scene.pin[0].point = {0, 0.1, 0};
  scene.pin[1].point = {0.1, 0.1, 0};
  return scene;
}

// Small levels stay in a cache.
TEST(StepProfile, KnowsTheBytesOfEveryLoop) {
  std::vector<Scene> scenes;
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit,
                                      Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2})
    scenes.push_back(hanging(integrator, 200));
  scenes.push_back(hanging(Integrator::implicit, 200));
  scenes.back().linear_precision = Precision::fp32;
  scenes.push_back(hanging(Integrator::implicit, 20000));  // whose first coarse level is not small
  scenes.back().newton_iterations = 1;
  for (const Scene& scene : scenes)
    for (const auto& [name, cost] : loops_of_steps(*make_simulation(scene, make_cloth(scene)), 2))
      EXPECT_EQ(cost.bytes > 0, name != "multigrid: small levels")
          << enum_name(scene.integrator) << ", " << name;
}

// A product reads a block of 3 x 3 numbers for each vertex and each end of an edge with the number of its
// column, where each row begins, and the vectors.
TEST(StepProfile, CountsAMatrixAndItsVectorsOnceAProduct) {
  Scene scene = hanging(Integrator::semi_implicit, 200);
  scene.fabric.warp = scene.fabric.weft =
      1e3;  // stiffer threads couple vertices of neighbouring triangles, too
  const Cloth cloth = make_cloth(scene);
  KernelCosts costs = loops_of_steps(*make_simulation(scene, cloth), 2);
  const double vertices = cloth.mesh.vertices(), ends = 2.0 * static_cast<double>(cloth.mesh.edge.size());
  const double vector = 3 * sizeof(double) * vertices, block = 9 * sizeof(double), index = sizeof(int);
  const double matrix = block * (vertices + ends) + index * (ends + vertices + 1);
  const auto per_call = [&](const char* kernel) {
    return costs.at(kernel).bytes / static_cast<double>(costs.at(kernel).calls);
  };
  EXPECT_EQ(per_call("solve: product"), matrix + 2 * vector);
  EXPECT_EQ(per_call("solve: direction"), 3 * vector);
  EXPECT_EQ(per_call("solve: advance"), block * vertices + 7 * vector);
}

TEST(CostOfSteps, OfASubstepIsAnEvenShareOfItsStep) {
  const Scene scene = hanging(Integrator::explicit_euler, 200);
  const Cloth cloth = make_cloth(scene);
  const auto whole = make_simulation(scene, cloth), shared = make_simulation(scene, cloth);
  const int substeps = whole->limits().substeps;
  ASSERT_GT(substeps, 1);
  const StepCost step = cost_of_steps(*whole, 2, 3), substep = cost_of_steps(*shared, 2, 3, substeps);
  EXPECT_GT(step.launches, substeps);
  EXPECT_DOUBLE_EQ(step.launches, substeps * substep.launches);
  EXPECT_LE(step.ms_fastest, step.ms);
  EXPECT_LE(step.ms, step.ms_slowest);
}

}  // namespace
}  // namespace hysteron::experiments
