#include "experiments/bench/parts.h"

#include <gtest/gtest.h>

#include <map>

#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

// Two squares over a ball, and all that can be left out.
HardScene full_scene() {
  Scene scene = default_scene();
  scene.cloth.length = 0.1;
  scene.cloth.copies = 2;
  scene.cloth.position = {-0.05, -0.05, 0.035};
  scene.triangles = 100;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.self_contact = true;
  scene.air_drag = 0.1;
  scene.param["fatigue.dc"] = "1";
  Obstacle ball;
  ball.kind = ObstacleKind::sphere;
  ball.radius = 0.03;
  scene.obstacle = {ball};
  return {"full", scene, make_cloth(scene)};
}

TEST(CostOfParts, HasARowForEachPartThatTheSceneHas) {
  const HardScene full = full_scene();
  const std::vector<Metrics> rows = cost_of_parts(full, 0, 1);
  ASSERT_EQ(rows.size(), 1 + omissions().size());
  EXPECT_EQ(rows[0]["without"].text(), "");
  for (std::size_t k = 0; k < omissions().size(); ++k)
    EXPECT_EQ(rows[k + 1]["without"].text(), omissions()[k].part);

  HardScene bare = full;
  for (const Omission& omission : omissions()) omission.leave_out(bare.scene);
  EXPECT_EQ(cost_of_parts(bare, 0, 1).size(), 1u) << "nothing is left to leave out";
}

TEST(CostOfParts, IsLessMemoryAndFewerLaunchesWithoutAPart) {
  std::map<std::string, Metrics> without;
  for (const Metrics& row : cost_of_parts(full_scene(), 0, 1)) without[row["without"].text()] = row;
  const auto cheaper = [&](const char* part, const char* key) {
    return without[part].number(key) < without[""].number(key);
  };
  for (const char* part : {"self-contact", "obstacles"})
    EXPECT_TRUE(cheaper(part, "launches_per_step")) << part;
  for (const char* part : {"self-contact", "hysteresis", "fatigue", "damping of bending"})
    EXPECT_TRUE(cheaper(part, "bytes_per_triangle")) << part;
}

}  // namespace
}  // namespace hysteron::experiments
