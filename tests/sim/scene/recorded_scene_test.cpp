#include "sim/scene/recorded_scene.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/scene/assets.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/scene_text.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

Scene shipped(const std::string& name) {
  Scene scene = default_scene();
  apply_scene_file(scene, name, {}, {"metric"});
  return scene;
}

// Of one's own numbers, with stops, a parameter of the law and a switched-off default.
Scene unusual() {
  Scene scene = shipped("strip-over-sphere");
  apply_flags(scene, {{"fabric.b1", "3.3e-05"},
                      {"fabric.bending.stops.thresholds", "5 20"},
                      {"fabric.bending.stops.stiffnesses", "8e-6 0.1"},
                      {"seed", "7"},
                      {"gravity", "0 0.1 -3"}});
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
    const Json tree = to_json(shipped(name));
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
           {R"({"pin": {}})", "scene.pin must be a list"},
           {R"({"pin": [{"low": 3}]})", "pin[0].low"},
           {R"({"param": {"stops": 3}})", "scene.param.stops must be a text"},
           {R"({"fabric": {"published": {"B": 3}}})", "scene.fabric.published.B"},
           {R"({"seconds": null})", "scene.seconds is no value"}}) {
    Scene scene = default_scene();
    const Failure failure =
        failure_of([&, text = tree] { apply_recorded_scene(scene, Json::parse(text), "manifest.json"); });
    EXPECT_EQ(failure.exit_code, 2);
    EXPECT_NE(failure.message.find(words), std::string::npos) << failure.message;
    EXPECT_NE(failure.message.find("manifest.json"), std::string::npos) << failure.message;
  }
}

TEST(SceneText, ReadsBackToTheSameScene) {
  std::vector<Scene> scenes = {unusual(), default_scene("polyester-faille")};
  for (const std::string& name : list_assets("scenes")) scenes.push_back(shipped(name));
  for (const Scene& scene : scenes) {
    const TextFile file(toml_of(scene));
    Scene back = default_scene();
    apply_scene_file(back, file.path());
    EXPECT_EQ(without_origins(back), without_origins(scene));
  }
}

TEST(SceneText, TellsTheOriginOfEachValue) {
  const std::string text = toml_of(unusual());
  for (const char* line : {"fabric.b1 = 3.3e-05  # [N m] --fabric.b1\n", "seed = 7  # --seed\n",
                           "element = \"shape\"  # assets/scenes/strip-over-sphere.toml:",
                           "fabric.b2 = 6.5704555e-06  # [N m] assets/fabrics/wool-tropical.toml:",
                           "air-drag = 0.0  # [kg/(m^2 s)] default\n"})
    EXPECT_NE(text.find(line), text.npos) << line << text;
}

TEST(SceneText, CommentsOutWhatTheExperimentAdds) {
  Scene scene = default_scene();
  scene.obstacle.emplace_back();  // without a place in a file
  scene.seconds = 3;
  const std::string text = toml_of(scene, {"seconds"});
  const TextFile file(text);
  Scene back = default_scene();
  apply_scene_file(back, file.path());
  EXPECT_TRUE(back.obstacle.empty());
  EXPECT_EQ(back.seconds, 3);
  EXPECT_NE(text.find("seconds = 3.0  # [s] the experiment's own\n"), text.npos) << text;
}

}  // namespace
}  // namespace hysteron
