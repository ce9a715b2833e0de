#include "experiments/bench/sizes.h"

#include "sim/scene/scene_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr double kRounding = 1e-12;

// Returns a square that hangs from two corners.
Scene hanging() {
  Scene scene = default_scene();
  scene.mesh = "aligned";
  scene.cloth.length = 0.1;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.pin.resize(2);
  for (Pin& pin : scene.pin) pin.select = PinSelection::nearest;
  scene.pin[0].point = {0, 0.1, 0};
  scene.pin[1].point = {0.1, 0.1, 0};
  return scene;
}

SizeTable sizes_table(const SizeParams& choice) {
  return times_by_size(hanging(), choice, [](const Metrics&) {});
}

TEST(TimesBySize, HaveARowForEachSizeAndIntegrator) {
  const SizeParams choice{
      {72, 18}, {Integrator::explicit_euler, Integrator::semi_implicit, Integrator::implicit}, 1};
  int heard = 0;
  const SizeTable table = times_by_size(hanging(), choice, [&](const Metrics&) { ++heard; });
  ASSERT_EQ(table.rows.size(), 6u);
  EXPECT_EQ(heard, 6);
  EXPECT_GT(table.copy_bandwidth, 0);
  std::size_t k = 0;
  for (const int triangles : {18, 72})
    for (const Integrator integrator : choice.integrators) {
      const Metrics& row = table.rows[k++];
      EXPECT_EQ(row.number("triangles"), triangles);
      EXPECT_EQ(row["integrator"].text(), enum_name(integrator));
      EXPECT_EQ(row["skipped"].text(), "");
      EXPECT_EQ(row["state_hash"].text().size(), 16u);
    }
}

TEST(TimesBySize, SetTheBytesOfAStepBesideACopy) {
  const SizeTable table = sizes_table({{32}, {Integrator::explicit_euler, Integrator::tr_bdf2}, 1});
  for (const Metrics& row : table.rows) {
    const double bytes = row.number("bytes_per_step"), floor = row.number("floor_ms_per_step");
    EXPECT_GT(bytes, 0);
    EXPECT_NEAR(floor, 1e3 * bytes / table.copy_bandwidth, kRounding * floor);
    EXPECT_NEAR(row.number("fraction_of_copy_bandwidth"), floor / row.number("ms_per_step"), kRounding);
  }
}

// Explicit steps are divided until they are stable: then a row is of one part, and moves as much as any
// other.
TEST(TimesBySize, AreOfOneStableStep) {
  const SizeTable table = sizes_table({{32, 128}, {Integrator::explicit_euler, Integrator::implicit}, 1});
  const auto at = [&](int row, const char* key) { return table.rows[row].number(key); };
  EXPECT_LT(at(0, "step_s"), hanging().step);
  EXPECT_LT(at(2, "step_s"), at(0, "step_s")) << "finer cloth asks for shorter steps";
  EXPECT_EQ(at(1, "step_s"), 1.0 / 60);
  EXPECT_EQ(at(3, "step_s"), 1.0 / 60);
  EXPECT_EQ(at(0, "solver_iterations_per_step"), 0);
  EXPECT_GT(at(1, "newton_iterations_per_step"), 0);
  // Explicit steps have one launch a loop, whatever their number, with the sum that looks for divergence.
  EXPECT_NEAR(at(0, "launches_per_step"), at(2, "launches_per_step"), 1);
  // Four times the triangles have twice the vertices along an edge, less one.
  EXPECT_GT(at(2, "bytes_per_step"), 3 * at(0, "bytes_per_step"));
  EXPECT_LT(at(2, "bytes_per_step"), 5 * at(0, "bytes_per_step"));
}

TEST(TimesBySize, AreLeftOutWhereTheBudgetCannotHoldThem) {
  SizeParams choice{{18, 72}, {Integrator::implicit}, 1};
  choice.budget = 1e-9;
  const SizeTable table = sizes_table(choice);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.device, "");
  for (const Metrics& row : table.rows) {
    EXPECT_TRUE(says(row["skipped"].text(), "budget"));
    EXPECT_FALSE(row["ms_per_step"].is_number());
  }
}

}  // namespace
}  // namespace hysteron::experiments
