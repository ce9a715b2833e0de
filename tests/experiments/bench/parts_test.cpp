#include "experiments/bench/parts.h"

#include <gtest/gtest.h>

#include <map>

#include "sim/scene/scene_reader.h"
#include "sim/time/ledger.h"

namespace hysteron::experiments {
namespace {

// Two squares over a ball, and all that can be left out.
HardScene full_scene() {
  Scene scene = default_scene("cotton-broad-k50");
  scene.cloth.length = 0.1;
  scene.cloth.copies = 2;
  scene.cloth.position = {-0.05, -0.05, 0.035};
  scene.triangles = 100;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.self_contact = true;
  scene.air_drag = 0.1;
  scene.param["fatigue.dc"] = "1";
  scene.fabric.in_plane.shear = {{0.01}, {10}};
  Obstacle ball;
  ball.kind = ObstacleKind::sphere;
  ball.radius = 0.03;
  scene.obstacle = {ball};
  return {"full", scene, make_cloth(scene)};
}

std::vector<Metrics> costs_of(const HardScene& scene, double budget = 1e9) {
  return cost_of_parts(scene, {.after = 0, .steps = 1}, Budget(budget), [](const Metrics&) {});
}

TEST(CostOfParts, HasARowForEachPartThatTheSceneHas) {
  const HardScene full = full_scene();
  const std::vector<Metrics> rows = costs_of(full);
  ASSERT_EQ(rows.size(), 1 + omissions().size() + 1);
  EXPECT_EQ(rows[0]["without"].text(), "");
  for (std::size_t k = 0; k < omissions().size(); ++k)
    EXPECT_EQ(rows[k + 1]["without"].text(), omissions()[k].part);
  EXPECT_EQ(rows.back()["without"].text(), "energy ledger");

  HardScene bare = full;
  for (const Omission& omission : omissions()) omission.leave_out(bare.scene);
  EXPECT_EQ(costs_of(bare).size(), 2u) << "nothing is left to leave out but the ledger";
}

TEST(CostOfParts, IsLessMemoryAndFewerLaunchesWithoutAPart) {
  std::map<std::string, Metrics> without;
  const auto less = [&](const char* part, const char* key) {
    return without[part].number(key) < without[""].number(key);
  };
  HardScene full = full_scene();
  for (const Metrics& row : costs_of(full)) without[row["without"].text()] = row;
  EXPECT_TRUE(less("self-contact", "bytes_per_triangle"));
  for (const char* part : {"self-contact", "obstacles", "friction in the plane", "energy ledger"})
    EXPECT_TRUE(less(part, "launches_per_step")) << part;
  full.scene.self_contact = false;  // whose lists of pairs grow with what the motion brings together
  for (const Metrics& row : costs_of(full)) without[row["without"].text()] = row;
  for (const char* part :
       {"obstacles", "hysteresis", "fatigue", "friction in the plane", "damping of bending", "energy ledger"})
    EXPECT_TRUE(less(part, "bytes_per_triangle")) << part;
}

// Implicit steps keep it in two loops, and in one record a vertex.
TEST(CostOfParts, OfTheLedgerIsThatOfItsLoopsAndRecords) {
  HardScene bare = full_scene();
  for (const Omission& omission : omissions())
    if (std::string(omission.part) != "damping of bending") omission.leave_out(bare.scene);
  bare.scene.integrator = Integrator::implicit;
  const std::vector<Metrics> rows = costs_of(bare);
  const Metrics &whole = rows.front(), &without = rows.back();
  const double records = static_cast<double>(bare.cloth.mesh.vertices() * sizeof(VertexLedger));
  EXPECT_EQ(whole.number("launches_per_step") - without.number("launches_per_step"), 2);
  EXPECT_NEAR(whole.number("bytes_per_triangle") - without.number("bytes_per_triangle"),
              records / bare.cloth.mesh.faces(), 1e-9 * records);
}

TEST(CostOfParts, IsNotMeasuredOnceTheBudgetIsUsedUp) {
  const std::vector<Metrics> rows = costs_of(full_scene(), 1e-9);
  ASSERT_EQ(rows.size(), 1 + omissions().size() + 1);
  for (const Metrics& row : rows) {
    EXPECT_NE(row["stopped"].text().find("budget"), std::string::npos);
    EXPECT_FALSE(row["ms_per_step"].is_number());
  }
}

}  // namespace
}  // namespace hysteron::experiments
