#include <nlohmann/json.hpp>

#include "sim/scene/scene_reader.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

const Json& at_path(const Json& tree, std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  return tree.at(Json::json_pointer("/" + path));
}

// Returns the manifest's value written as a flag.
std::string flag_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.dump();  // numbers, [x,y,z]
}

TEST(ResolvedScene, HoldsEveryKey) {
  const Json tree = to_json(default_scene());
  for (const KeyDescription& key : scene_keys()) EXPECT_NO_THROW(at_path(tree, key.path)) << key.path;
}

// Friction is what was said last: the fabric's three numbers, a tester's pair with k0 or with a shape, or
// stops.
TEST(FrictionOfAFabric, IsWhatWasSetLast) {
  const auto set = [](Scene& scene, const std::string& key, const std::string& text) {
    set_key(scene, "fabric." + key, text, "--fabric." + key);
  };
  Scene scene = default_scene("cotton-broad");
  const Fabric cotton = scene.fabric;
  set(scene, "k0", "20");
  EXPECT_EQ(scene.fabric.b1, cotton.b1);
  set(scene, "kes-b", "1e-5");
  EXPECT_EQ(scene.fabric.b1, cotton.b1);
  EXPECT_THROW(check_scene(scene), Error) << "half of a pair";
  set(scene, "kes-2hb", "8e-4");
  EXPECT_EQ(scene.fabric.b2, 1e-5);
  EXPECT_DOUBLE_EQ(scene.fabric.b1, 1e-5 + 8e-4 / 20);
  set(scene, "k0", "10");
  EXPECT_DOUBLE_EQ(scene.fabric.b1, 1e-5 + 8e-4 / 10) << "the pair stays";
  set(scene, "stops-median", "17");
  set(scene, "stops-spread", "2");
  ASSERT_TRUE(scene.fabric.kes.on());
  EXPECT_EQ(scene.fabric.bending.stops.size(), 8u);
  EXPECT_DOUBLE_EQ(scene.fabric.k0,
                   2 * scene.fabric.bending.stops.friction_moment() / (scene.fabric.b1 - scene.fabric.b2));
  set(scene, "bending.stops.thresholds", "3 4 5 6 7 8 9 10");
  EXPECT_FALSE(scene.fabric.kes.on());
  EXPECT_EQ(scene.fabric.bending.stops.thresholds.back(), 10);
}

// In any order: what one command line says twice is refused.
TEST(FrictionOfAFabric, IsNotSaidTwiceByOneSource) {
  using Flags = std::vector<Flag>;
  const Flags pair = {{"fabric.kes-b", 1e-5}, {"fabric.kes-2hb", 1e-3}};
  for (const Flags& other : {Flags{{"fabric.b1", 5e-5}}, Flags{{"fabric.b2", 2e-5}},
                             Flags{{"fabric.bending.stops.thresholds", Numbers{4, 15}},
                                   {"fabric.bending.stops.stiffnesses", Numbers{9e-6, 5e-6}}}})
    for (const bool pair_first : {true, false}) {
      Flags flags = pair_first ? pair : other;
      const Flags& rest = pair_first ? other : pair;
      flags.insert(flags.end(), rest.begin(), rest.end());
      Scene scene = default_scene("cotton-broad");
      apply_flags(scene, flags);
      EXPECT_TRUE(says(refusal([&] { check_scene(scene); }), "say two frictions")) << other[0].path;
    }
}

// A fabric whose file states the pair may be given one number of it anew.
TEST(FrictionOfAFabric, OfAPairIsChangedByEitherNumberOfIt) {
  const test::Folder folder;
  const std::string file =
      folder.write("pair.toml",
                   "[parameters]\ndensity = 0.12\nthickness = 4e-4\nkes-b = 1e-5\nkes-2hb = 1e-3\nk0 = "
                   "8\nweft-bending = 1\n"
                   "warp = 200\nweft = 200\nshear = 40\ndamping = 1e-3\nfriction = 0.3\n");
  Scene scene = default_scene();
  apply_flags(scene, {{"fabric", file}, {"fabric.kes-2hb", 2e-3}});
  EXPECT_NO_THROW(check_scene(scene));
  EXPECT_DOUBLE_EQ(scene.fabric.b2, 1e-5);
  EXPECT_DOUBLE_EQ(scene.fabric.b1, 1e-5 + 2e-3 / 8);
}

// Stops and the three numbers that laws without stops take are one friction.
TEST(FrictionOfAFabric, OfStopsIsThatOfItsThreeNumbers) {
  Scene scene = default_scene("cotton-broad-k50");
  set_key(scene, "fabric.bending.stops.thresholds", "10 50", "--fabric.bending.stops.thresholds");
  set_key(scene, "fabric.bending.stops.stiffnesses", "8e-6 2e-6", "--fabric.bending.stops.stiffnesses");
  EXPECT_DOUBLE_EQ(scene.fabric.b1, scene.fabric.b2 + 1e-5);
  EXPECT_DOUBLE_EQ(scene.fabric.k0, 2 * (10 * 8e-6 + 50 * 2e-6) / 1e-5);
  EXPECT_NO_THROW(check_scene(scene));
  set_key(scene, "fabric.b2", "1e-5", "--fabric.b2");
  EXPECT_DOUBLE_EQ(scene.fabric.b1, 2e-5);
  Scene both = scene;
  set_key(both, "fabric.k0", "20", "--fabric.k0");
  EXPECT_TRUE(
      test::says(test::refusal([&] { check_scene(both); }), "fabric.k0 = 20 1/m (--fabric.k0) must be 36"));
  set_key(scene, "fabric.k0", "20", "scene.toml:3");
  EXPECT_TRUE(scene.fabric.bending.stops.empty()) << "which were set before, elsewhere";
}

TEST(BiasBending, IsTheMeanOfWarpAndWeftUnlessItIsStated) {
  Scene scene = default_scene("cotton-broad");  // whose file assumes 1 of both
  set_key(scene, "fabric.weft-bending", "0.5", "--fabric.weft-bending");
  EXPECT_EQ(scene.fabric.bias_bending, 0.75);
  set_key(scene, "fabric.bias-bending", "1", "--fabric.bias-bending");
  set_key(scene, "fabric.weft-bending", "0.6", "--fabric.weft-bending");
  EXPECT_EQ(scene.fabric.bias_bending, 1);
  set_key(scene, "fabric.name", "navy-sparkle-sweat", "--fabric");  // whose file derives both
  set_key(scene, "fabric.weft-bending", "0.6", "--fabric.weft-bending");
  EXPECT_EQ(scene.fabric.bias_bending, 0.673819);
}

TEST(FrictionOfAFabric, LeavesElasticityBesideIt) {
  Scene scene = default_scene("cotton-broad");
  set_key(scene, "fabric.stops-median", "17", "--fabric.stops-median");
  set_key(scene, "fabric.stops-spread", "2", "--fabric.stops-spread");
  set_key(scene, "fabric.kes-b", "1.2e-5", "--fabric.kes-b");
  set_key(scene, "fabric.kes-2hb", "0.04", "--fabric.kes-2hb");
  EXPECT_TRUE(test::says(test::refusal([&] { check_scene(scene); }), "no elasticity is left"));
  set_key(scene, "fabric.kes-2hb", "0", "--fabric.kes-2hb");
  EXPECT_NO_THROW(check_scene(scene));
  EXPECT_EQ(scene.fabric.b1, scene.fabric.b2);
}

// Half of what the tester reads says nothing: the other half is named.
TEST(FrictionOfAFabric, OfATesterNamesWhatIsMissing) {
  const auto said_to = [](const std::vector<Flag>& flags) {
    Scene scene = default_scene("cotton-broad-k50");
    apply_flags(scene, flags);
    return test::refusal([&] { check_scene(scene); });
  };
  const Flag rigidity = {"fabric.kes-b", 1e-5}, width = {"fabric.kes-2hb", 1e-3},
             median = {"fabric.stops-median", 17}, spread = {"fabric.stops-spread", 2},
             no_width = {"fabric.kes-2hb", 0};
  const std::pair<std::vector<Flag>, const char*> cases[] = {
      {{no_width},
       "fabric.kes-2hb = 0 N (--fabric.kes-2hb) must be > 0: for a fabric without friction take law = "
       "linear, "
       "or fabric.b1 = fabric.b2"},
      {{rigidity, no_width}, "fabric.kes-2hb = 0 N (--fabric.kes-2hb) must be > 0: "},
      {{{"fabric.kes-b", 0}, width}, "fabric.kes-b = 0 N m (--fabric.kes-b) must be > 0"},
      {{rigidity}, "fabric.kes-b = 1e-05 N m (--fabric.kes-b) needs fabric.kes-2hb beside it"},
      {{width}, "fabric.kes-2hb = 0.001 N (--fabric.kes-2hb) needs fabric.kes-b beside it"},
      {{spread}, "fabric.stops-spread = 2 (--fabric.stops-spread) needs fabric.stops-median beside it"},
      {{median, rigidity, width}, "(--fabric.stops-median) needs fabric.stops-spread beside it"},
      {{median, spread, width}, "(--fabric.stops-median) needs fabric.kes-b beside it"},
      {{median, spread, rigidity}, "(--fabric.stops-median) needs fabric.kes-2hb beside it"}};
  for (const auto& [flags, message] : cases) EXPECT_TRUE(test::says(said_to(flags), message));
  EXPECT_EQ(said_to({rigidity, width}), "(accepted)");
  EXPECT_EQ(said_to({median, spread, rigidity, width}), "(accepted)");
  EXPECT_EQ(said_to({median, {"fabric.stops-spread", 0.1}, rigidity, no_width}), "(accepted)")
      << "a shape of no friction";
}

TEST(ResolvedScene, ReadBackAsFlagsGivesTheSameScene) {
  Scene original = default_scene("wool-tropical");
  apply_flags(original, {{"gravity", Numbers{0.1, 0, -9.81}},
                         {"step", 3.3e-4},
                         {"seed", 4294967295},
                         {"fabric.k0", 0.1},
                         {"fabric.bending.stops.thresholds", Numbers{3, 1e2}},
                         {"fabric.bending.stops.stiffnesses", Numbers{1.1e-6, 2e-7}}});
  const Json tree = to_json(original);
  Scene copy = default_scene();
  for (const KeyDescription& key : scene_keys()) {
    if (key.type != "name=value") set_key(copy, key.path, flag_text(at_path(tree, key.path)), "copy");
  }
  const Json again = to_json(copy);
  for (const KeyDescription& key : scene_keys()) EXPECT_EQ(at_path(again, key.path), at_path(tree, key.path));
}

TEST(ResolvedScene, TellsWhereEachFabricNumberComesFrom) {
  Scene scene = default_scene();
  set_key(scene, "fabric.friction", "0.5", "--fabric.friction");
  const Json fabric = to_json(scene).at("fabric");
  EXPECT_EQ(fabric.at("provenance").at("friction").at("confidence"), "given");
  EXPECT_EQ(fabric.at("provenance").at("b2").at("confidence"), "published");
  EXPECT_EQ(fabric.at("provenance").at("b1").at("confidence"), "derived");
  EXPECT_EQ(fabric.at("published").at("B").at("unit"), "gf cm^2/cm");
}

TEST(Vectors, MayBeWrittenWithSpacesOrCommas) {
  for (const char* text : {"0 0 -9.81", "0,0,-9.81", "[0, 0, -9.81]"}) {
    Scene scene;
    set_key(scene, "gravity", text, "--gravity");
    EXPECT_EQ(scene.gravity, Eigen::Vector3d(0, 0, -9.81)) << text;
  }
}

TEST(Values, AreReadBackFromTheirTexts) {
  const auto key = [](const char* type) {
    KeyDescription description;
    description.type = type;
    return description;
  };
  const std::tuple<const char*, Value, const char*> cases[] = {
      {"flag", false, "false"},
      {"integer", 4294967295, "4294967295"},
      {"number", 1.0 / 3, "0.3333333333333333"},
      {"number", 1e300, "1e+300"},
      {"vector", Numbers{0, -0.1, 1e-7}, "0 -0.1 1e-07"},
      {"numbers", Numbers{}, "[]"},
      {"numbers", Numbers{0.1}, "0.1"},
      {"text", "1e-5", "1e-5"},
      {"name=value", "stops=16", "stops=16"},
  };
  for (const auto& [type, value, text] : cases) {
    EXPECT_EQ(value_text(value), text);
    EXPECT_EQ(parse_text(key(type), text), value) << text;
  }
}

TEST(NearestName, IsTheOneWithFewestEdits) {
  EXPECT_EQ(nearest_name("fabric.b22", {"fabric.b1", "fabric.b2", "step"}), "fabric.b2");
  EXPECT_EQ(nearest_name("gravty", {"gravity", "density"}), "gravity");
}

}  // namespace
}  // namespace hysteron
