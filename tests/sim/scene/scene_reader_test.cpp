#include "sim/scene/scene_reader.h"

#include "sim/scene/assets.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

TEST(Precedence, FlagsWinOverTheSceneFileAndTheFileOverDefaults) {
  const TextFile file("step = 2e-3\nseconds = 3\n");
  Scene scene = default_scene();
  scene.triangles = 1234;
  scene.seconds = 7;
  apply_scene_file(scene, file.path());
  apply_flags(scene, {{"step", 5e-4}});
  EXPECT_EQ(scene.triangles, 1234);
  EXPECT_EQ(scene.seconds, 3);
  EXPECT_EQ(scene.step, 5e-4);
  EXPECT_EQ(scene.origin.at("seconds"), file.line(2));
  EXPECT_EQ(scene.origin.at("step"), "--step");
}

TEST(Precedence, ASingleFabricNumberOverridesTheFabricWhateverTheOrder) {
  Scene scene = default_scene();
  apply_flags(scene, {{"fabric.k0", 20}, {"fabric", "wool-tropical"}});
  EXPECT_EQ(scene.fabric.name, "wool-tropical");
  EXPECT_EQ(scene.fabric.k0, 20);
  EXPECT_EQ(scene.fabric.density, 0.1629);
}

TEST(Precedence, NamingAFabricStartsItAfresh) {
  Scene scene = scene_of("[fabric]\nk0 = 20\nname = \"polyester-faille\"\n");
  EXPECT_EQ(scene.fabric.k0, 20);
  apply_flags(scene, {{"fabric", "wool-tropical-k50"}});
  EXPECT_EQ(scene.fabric.k0, 50);
  EXPECT_EQ(scene.origin.at("fabric.name"), "--fabric");
}

TEST(Precedence, ParametersAccumulateAndTheLastOneWins) {
  const TextFile file("[param]\nmemory = \"stops\"\nstops = 16\n");
  Scene scene = default_scene();
  apply_scene_file(scene, file.path());
  apply_flags(scene, {{"param", "stops=32"}});
  EXPECT_EQ(scene.param.at("memory"), "stops");
  EXPECT_EQ(scene.param.at("stops"), "32");
  EXPECT_EQ(scene.origin.at("param.memory"), file.line(2));
  EXPECT_EQ(scene.origin.at("param.stops"), "--param");
  EXPECT_NO_THROW(check_scene(scene));
}

TEST(ShippedScenes, AreReadUnderTheNameThatIsListed) {
  const std::vector<std::string> names = list_assets("scenes");
  EXPECT_FALSE(names.empty());
  for (const std::string& name : names) {
    Scene scene;
    ASSERT_NO_THROW(scene = test::shipped_scene(name)) << name;
    EXPECT_EQ(scene.origin.begin()->second.find("assets/scenes/" + name), 0) << scene.origin.begin()->second;
  }
}

TEST(SceneFile, MayNameItsFabricAtTheTopLevel) {
  EXPECT_EQ(scene_of("fabric = \"polyester-tropical\"\n").fabric.name, "polyester-tropical");
}

TEST(SceneFile, GivesPinsAndObstaclesWithTheirMotion) {
  const TextFile file(R"(
[[pin]]
select = "nearest"
point = [0.5, 0, 0]
until = 2
keys = [{time = 0}, {time = 1, position = [0, 0, 0.1], angle = 90}]
[[obstacle]]
kind = "cylinder"
radius = 0.09
[[obstacle]]
kind = "ground"
friction = 0.7
visible = false
motion-axis = [0, 1, 0]
)");
  Scene scene = default_scene();
  scene.obstacle.resize(5);
  apply_scene_file(scene, file.path());
  check_scene(scene);
  ASSERT_EQ(scene.pin.size(), 1u);
  EXPECT_EQ(scene.pin[0].point, Eigen::Vector3d(0.5, 0, 0));
  EXPECT_EQ(scene.pin[0].until, 2);
  ASSERT_EQ(scene.pin[0].motion.keys.size(), 2u);
  EXPECT_EQ(scene.pin[0].motion.keys[1].position, Eigen::Vector3d(0, 0, 0.1));
  EXPECT_EQ(scene.pin[0].motion.keys[1].angle, 90);
  ASSERT_EQ(scene.obstacle.size(), 2u);
  EXPECT_EQ(scene.obstacle[0].radius, 0.09);
  EXPECT_EQ(scene.obstacle[1].friction, 0.7);
  EXPECT_FALSE(scene.obstacle[1].visible);
  EXPECT_EQ(scene.obstacle[1].motion.axis, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(scene.origin.at("obstacle[1]"), file.line(10));
}

TEST(SceneFile, FindsAClothBesideItself) {
  const test::Folder folder;
  folder.write("cloth.obj", "");
  Scene scene = default_scene();
  apply_scene_file(scene, folder.write("scene.toml", "mesh = \"cloth.obj\"\n"));
  EXPECT_EQ(std::filesystem::path(scene.mesh), folder.path() / "cloth.obj");
}

// However they are written.
TEST(SceneFile, TakesIntegersWithAnExponent) {
  Scene scene = scene_of("triangles = 1e3\nseed = 7.0\n");
  EXPECT_EQ(scene.triangles, 1000);
  EXPECT_EQ(scene.seed, 7u);
  apply_flags(scene, {{"triangles", 2.5e3}, {"seed", 1e1}});
  EXPECT_EQ(scene.triangles, 2500);
  EXPECT_EQ(scene.seed, 10u);
}

TEST(SceneFile, LeavesNoTableToOthersThatIsNoArray) {
  const TextFile file("[metric]\nname = \"a\"\n");
  Scene scene;
  EXPECT_EQ(test::refusal([&] { apply_scene_file(scene, file.path(), {}, {"metric"}); }),
            "metric must be an array of tables, [[metric]] (" + file.line(1) + ")");
}

TEST(SceneFile, SetsAnExperimentsOwnKeysToo) {
  double frames_per_second = 0;
  const Field field = &frames_per_second;
  const Keys own = {{describe("fps", field, "1/s", positive(), "pictures"), field}};
  const TextFile file("fps = 25\n");
  Scene scene = default_scene();
  apply_scene_file(scene, file.path(), own);
  EXPECT_EQ(frames_per_second, 25);
  apply_flags(scene, {{"fps", 50}}, own);
  EXPECT_EQ(frames_per_second, 50);
}

TEST(LinearFabric, NeedsNoElasticLimit) {
  Scene scene = default_scene();
  apply_flags(scene, {{"fabric.b1", 1e-5}, {"fabric.b2", 1e-5}, {"fabric.k0", 0}});
  EXPECT_NO_THROW(check_scene(scene));
}

}  // namespace
}  // namespace hysteron
