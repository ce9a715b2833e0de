#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sim/scene/assets.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/scene_text.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

// Returns a scene with numbers of its own, stops, a parameter of the law and a switched-off default.
Scene unusual() {
  Scene scene = test::shipped_scene("strip-over-sphere");
  apply_flags(scene, {{"fabric.b1", 3.3e-05},
                      {"fabric.bending.stops.thresholds", Numbers{5, 20}},
                      {"fabric.bending.stops.stiffnesses", Numbers{8e-6, 0.1}},
                      {"seed", 7},
                      {"gravity", Numbers{0, 0.1, -3}}});
  return scene;
}

Json without_origins(const Scene& scene) {
  Json tree = to_json(scene);
  tree.erase("origin");
  tree["fabric"].erase("provenance");
  return tree;
}

TEST(RecordedScene, IsTheSceneThatWasRecorded) {
  for (const std::string& name : list_assets("scenes")) {
    const Json tree = to_json(test::shipped_scene(name));
    Scene back;
    apply_recorded_scene(back, tree, "manifest.json");
    EXPECT_EQ(to_json(back), tree) << name;
  }
  const Json tree = Json::parse(to_json(unusual()).dump());
  Scene back = default_scene("wool-tropical");
  apply_recorded_scene(back, tree, "manifest.json");
  EXPECT_EQ(to_json(back), tree);
}

TEST(RecordedScene, NeedsNoFileOfTheFabric) {
  Scene scene = default_scene();
  scene.fabric.name = "of-no-file";
  Scene back = default_scene();
  EXPECT_NO_THROW(apply_recorded_scene(back, to_json(scene), "manifest.json"));
  EXPECT_EQ(back.fabric.name, "of-no-file");
}

TEST(RecordedScene, RefusesInOneLineThatNamesTheKey) {
  for (const auto& [tree, words] : std::vector<std::pair<const char*, const char*>>{
           {R"({"fabric": {"b3": 1.0}})", "fabric.b3"},
           {R"({"step": -1.0})", "step = -1 s must be"},
           {R"({"pin": {}})", "pin must be an array of tables, [[pin]]"},
           {R"({"pin": [{"low": 3}]})", "pin[0].low"},
           {R"({"param": {"stops": [3]}})", "param.stops must be a text or a number"},
           {R"({"fabric": {"published": {"B": 3}}})", "scene.fabric.published.B"},
           {R"({"seconds": null})", "seconds is no value"}}) {
    Scene scene = default_scene();
    const std::string reason =
        test::refusal([&, text = tree] { apply_recorded_scene(scene, Json::parse(text), "manifest.json"); });
    EXPECT_TRUE(test::says(reason, words, "manifest.json"));
  }
}

TEST(SceneText, ReadsBackToTheSameScene) {
  std::vector<Scene> scenes = {unusual(), default_scene("polyester-faille")};
  for (const std::string& name : list_assets("scenes")) scenes.push_back(test::shipped_scene(name));
  for (const Scene& scene : scenes)
    EXPECT_EQ(without_origins(scene_of(scene_toml(scene))), without_origins(scene));
}

TEST(SceneText, TellsTheOriginOfEachValue) {
  const std::string text = scene_toml(unusual());
  for (const char* line : {"fabric.b1 = 3.3e-05  # [N m] --fabric.b1\n", "seed = 7  # --seed\n",
                           "element = \"shape\"  # assets/scenes/strip-over-sphere.toml:",
                           "fabric.density = 0.1629  # [kg/m^2] assets/fabrics/wool-tropical.toml:",
                           "air-drag = 0.0  # [kg/(m^2 s)] default\n"})
    EXPECT_TRUE(test::says(text, line));
}

TEST(SceneText, CommentsOutWhatTheExperimentAdds) {
  Scene scene = default_scene();
  scene.obstacle.emplace_back();  // without a place in a file
  scene.seconds = 3;
  const std::string text = scene_toml(scene, {"seconds"});
  const Scene back = scene_of(text);
  EXPECT_TRUE(back.obstacle.empty());
  EXPECT_EQ(back.seconds, 3);
  EXPECT_TRUE(test::says(text, "seconds = 3.0  # [s] the experiment's own\n"));
}

// A number in the key's range whose last bits six digits would lose.
double with_all_bits(const Range& range) {
  const double low = std::isfinite(range.low) ? range.low : 0;
  return low + (std::isfinite(range.high) ? range.high - low : 1) / 3;
}

// Returns all numbers of a scene.
std::vector<double> number_values(Scene scene) {
  std::vector<double> all;
  for (const BoundKey& key : bind_scene(scene)) {
    if (const auto* x = std::get_if<double*>(&key.field)) all.push_back(**x);
    if (const auto* x = std::get_if<Eigen::Vector3d*>(&key.field))
      all.insert(all.end(), (*x)->begin(), (*x)->end());
    if (const auto* x = std::get_if<Numbers*>(&key.field)) all.insert(all.end(), (*x)->begin(), (*x)->end());
  }
  return all;
}

Scene with_all_bits() {
  Scene scene = default_scene();
  for (const BoundKey& key : bind_scene(scene)) {
    const double x = with_all_bits(key.description.range);
    if (const auto* number = std::get_if<double*>(&key.field)) **number = x;
    if (const auto* vector = std::get_if<Eigen::Vector3d*>(&key.field)) **vector = {x, -x, x / 7};
    if (const auto* numbers = std::get_if<Numbers*>(&key.field)) **numbers = {x / 7, x};
  }
  scene.fabric.follow_kes();
  scene.fabric.bending.weft_stops = scene.fabric.bending.stops;  // as many
  return scene;
}

// The same scene by flags, as studies, comparisons and estimates of errors tell it to runs.
std::vector<Flag> drape_flags(Scene scene) {
  // Another process gets texts.
  const auto told = [](const KeyDescription& key, const Value& value) {
    return Flag{key.path, parse_text(key, value_text(value))};
  };
  std::vector<Flag> flags;
  for (const BoundKey& key : bind_scene(scene)) {
    const KeyDescription& what = key.description;
    if (const auto* x = std::get_if<double*>(&key.field)) flags.push_back(told(what, **x));
    if (const auto* x = std::get_if<Eigen::Vector3d*>(&key.field))
      flags.push_back(told(what, Numbers((*x)->begin(), (*x)->end())));
    if (const auto* x = std::get_if<Numbers*>(&key.field)) flags.push_back(told(what, **x));
  }
  return flags;
}

TEST(ResolvedScene, ReachesAnotherRunWithEveryBitWhateverItIsTold) {
  const Scene scene = with_all_bits();
  const std::vector<double> wanted = number_values(scene);
  const auto same_bits = [&](const Scene& other) {
    const std::vector<double> found = number_values(other);
    return found.size() == wanted.size() &&
           std::memcmp(found.data(), wanted.data(), wanted.size() * sizeof(double)) == 0;
  };
  Scene by_manifest = default_scene(), by_flags = default_scene();
  apply_recorded_scene(by_manifest, Json::parse(to_json(scene).dump()), "manifest.json");
  EXPECT_TRUE(same_bits(by_manifest));
  EXPECT_TRUE(same_bits(scene_of(scene_toml(scene))));
  apply_flags(by_flags, drape_flags(scene));
  EXPECT_TRUE(same_bits(by_flags));
}

}  // namespace
}  // namespace hysteron
