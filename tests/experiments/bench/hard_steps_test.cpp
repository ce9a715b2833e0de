#include "experiments/bench/hard_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr int kSteps = 4;

// A square that is let fall onto a ball, in its first 20 steps.
Scene falling() {
  Scene scene = default_scene();
  scene.cloth.length = 0.1;
  scene.cloth.position = {-0.05, -0.05, 0.035};
  scene.triangles = 80;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.step = 1.0 / 240;
  scene.seconds = 20 * scene.step;
  Obstacle ball;
  ball.kind = ObstacleKind::sphere;
  ball.radius = 0.03;
  scene.obstacle = {ball};
  return scene;
}

HardScene falling_scene(const Scene& scene) { return {"falling", scene, make_cloth(scene)}; }

// Newton's iterations of each step.
std::vector<long> iterations(const Scene& scene) {
  const auto simulation = make_simulation(scene, make_cloth(scene));
  std::vector<long> result;
  for (long before = 0; result.size() < 20;) {
    simulation->advance(1);
    const long now = simulation->solver_counts().newton;
    result.push_back(now - before);
    before = now;
  }
  return result;
}

const Metrics& row_of(const std::vector<Metrics>& rows, const std::string& variant,
                      const std::string& scene) {
  for (const Metrics& row : rows)
    if (row["variant"].text() == variant && row["scene"].text() == scene) return row;
  throw std::out_of_range(variant);
}

TEST(HardSteps, AreThoseThatTookMostIterationsAndTakeThemAgain) {
  const Scene scene = falling();
  std::vector<long> all = iterations(scene);
  std::sort(all.rbegin(), all.rend());
  const long most = std::accumulate(all.begin(), all.begin() + kSteps, 0L);
  const HardStates hard = find_hard_steps(falling_scene(scene), kSteps);
  EXPECT_EQ(hard.broken_off, "");
  ASSERT_EQ(hard.states.size(), static_cast<std::size_t>(kSteps));
  const std::vector<SolverVariant> in_use = {solver_variants().front()};
  const std::vector<Metrics> rows = hard_step_table({hard, hard}, in_use, 2, [](const std::string&) {});
  EXPECT_EQ(rows.size(), 3u);
  EXPECT_EQ(row_of(rows, "in use", "falling").number("newton_iterations"), most);
  EXPECT_EQ(row_of(rows, "in use", "all").number("newton_iterations"), 2 * most);
  EXPECT_EQ(row_of(rows, "in use", "all").number("steps"), 2 * kSteps);
  const double length = row_of(rows, "in use", "all").number("mean_step_length");
  EXPECT_GT(length, 0);
  EXPECT_LE(length, 1);
}

// The choices lead to the same equilibrium on other ways; with friction, to that of other limits.
TEST(HardSteps, OfEveryVariantEndInTheSameStateOnTheirOwnWays) {
  Scene scene = falling();
  scene.fabric.friction = 0;
  scene.newton_residual = 1e-9;
  scene.newton_velocity = 1e-12;
  scene.step /= 2;  // in longer ones the blow may buckle the square into one of several
  const HardStates hard = find_hard_steps(falling_scene(scene), 1);
  std::vector<std::vector<Eigen::Vector3d>> ends;
  std::set<long> linear;
  for (const SolverVariant& variant : solver_variants()) {
    Scene chosen = scene;
    variant.choose(chosen.tuning);
    const auto simulation = make_simulation(chosen, hard.of.cloth);
    simulation->load(hard.states.front());
    const long before = simulation->solver_counts().linear;
    simulation->advance(1);
    linear.insert(simulation->solver_counts().linear - before);
    ends.push_back(simulation->positions());
  }
  for (const auto& end : ends)
    for (std::size_t i = 0; i < end.size(); ++i) EXPECT_NEAR((end[i] - ends[0][i]).norm(), 0, 1e-6);
  EXPECT_GT(linear.size(), 2u) << "variants do the same";
}

TEST(HardSteps, ThatCannotBeTakenAreCounted) {
  Scene scene = falling();
  const HardStates hard = find_hard_steps(falling_scene(scene), 1);
  HardStates impossible = hard;
  impossible.of.scene.newton_residual = 0;
  impossible.of.scene.newton_velocity = 0;
  impossible.of.scene.newton_iterations = 1;
  const std::vector<Metrics> rows =
      hard_step_table({impossible}, {solver_variants().front()}, 1, [](const std::string&) {});
  EXPECT_EQ(row_of(rows, "in use", "all").number("unbalanced"), 1);
}

TEST(HardScenes, BringTheSpecimensOfOtherExperimentsAndSceneFilesOnOneDevice) {
  Scene like = default_scene();
  like.threads = 1;
  like.device = DeviceChoice::cpu;
  for (const char* name :
       {"fold", "drape", "crumple-press"}) {  // a crease first looks for its plate's height
    const HardScene hard = hard_scene(name, 120, like);
    EXPECT_EQ(hard.name, name);
    EXPECT_EQ(hard.scene.threads, 1);
    EXPECT_GT(hard.cloth.mesh.faces(), 60) << name;
    EXPECT_EQ(hard.scene.self_contact, std::string(name) != "drape") << name;
    EXPECT_FALSE(hard.scene.obstacle.empty()) << name;
    make_simulation(hard.scene, hard.cloth)->advance(1);
  }
}

TEST(HardScenes, AreAllShippedOnesOnceAndTheSpecimens) {
  const std::vector<std::string> names = hard_scene_names();
  EXPECT_EQ(names.size(), list_assets("scenes").size() + 3);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  Scene like = default_scene();
  like.device = DeviceChoice::cpu;
  for (const std::string& name : list_assets("scenes"))
    EXPECT_GT(hard_scene(name, 60, like).cloth.mesh.faces(), 30) << name;
}

TEST(HardScenes, DrapeTheLimpestOfTheShippedFabrics) {
  std::map<double, std::string> by_rigidity;
  for (const std::string& name : list_assets("fabrics"))
    by_rigidity.emplace(read_fabric(name, "test").fabric.b2, name);
  EXPECT_EQ(by_rigidity.begin()->second, kLimpest);
}

}  // namespace
}  // namespace hysteron::experiments
