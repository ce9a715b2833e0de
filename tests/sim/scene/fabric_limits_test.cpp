// Numbers that no fabric has are refused wherever they enter, unusual ones are warned of, and shipped fabrics
// pass.
#include "sim/scene/fabric_limits.h"

#include <gtest/gtest.h>

#include "sim/scene/cloth.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/shown_key.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::says;

std::string refusal_of(const std::string& key, double value) {
  Scene scene = default_scene();
  return test::refusal([&] {
    apply_flags(scene, {{key, value}});
    check_scene(scene);
  });
}

TEST(FabricLimits, RefuseWhatNoFabricHasAndNameTheUnitThatWasProbablyMeant) {
  const std::string density = refusal_of("fabric.density", 124);
  EXPECT_TRUE(says(density, "fabric.density = 124 kg/m^2 must be in [0.001, 20] kg/m^2"));
  EXPECT_TRUE(says(density, "g/m^2 given? Then it is 0.124 kg/m^2"));
  EXPECT_TRUE(says(density, "(--fabric.density)"));
  EXPECT_TRUE(says(refusal_of("fabric.thickness", 0.4), "mm given? Then it is 0.0004 m"));
  // 0.118 gf cm^2/cm times 9.80665e-5 N m.
  EXPECT_TRUE(says(refusal_of("fabric.kes-b", 0.118), "fabric.kes-b = 0.118 N m must be"));
  EXPECT_TRUE(says(refusal_of("fabric.kes-b", 0.118), "gf cm^2/cm given? Then it is 1.16e-05 N m"));
  EXPECT_TRUE(says(refusal_of("fabric.weft-bending", 1e-5), "It is a ratio"));
}

TEST(FabricLimits, RefuseThemInAFabricsFileAtTheirLine) {
  const test::Folder folder;
  std::string text = "name = \"f\"\ndescription = \"d\"\n[parameters]\n";
  for (const char* entry : {"b1 = {value = 4e-5, unit = \"N m\"", "b2 = {value = 1e-5, unit = \"N m\"",
                            "k0 = {value = 40, unit = \"1/m\"", "density = {value = 124, unit = \"kg/m^2\"",
                            "thickness = {value = 4e-4, unit = \"m\""})
    text += std::string(entry) + ", source = \"x\", confidence = \"given\"}\n";
  const std::string file = folder.write("f.toml", text);
  const std::string said = test::refusal([&] { read_fabric(file, "test"); });
  EXPECT_TRUE(says(said, "fabric.density = 124 kg/m^2 must be"));
  EXPECT_TRUE(says(said, "f.toml:7")) << "the line of density";
}

TEST(FabricLimits, RefuseFacesThatDifferBesideWhatHasNoSide) {
  const auto refusal_with = [](const std::vector<Flag>& flags) {
    Scene scene = default_scene();
    return test::refusal([&] {
      apply_flags(scene, flags);
      check_scene(scene);
    });
  };
  const Flag back = {"fabric.back-friction", 1.5};
  EXPECT_NO_THROW({
    Scene scene = default_scene();
    apply_flags(scene, {back, {"fabric.back-bending", 0.8}, {"fabric.weft-friction", 0.9}});
    check_scene(scene);
  });
  EXPECT_TRUE(
      says(refusal_with({back, {"fabric.bending.set.yield", 400}, {"fabric.bending.set.hardening", 5e-6}}),
           "fabric.back-friction = 1.5 (--fabric.back-friction) goes without fabric.bending.set"));
  EXPECT_TRUE(
      says(refusal_with({back, {"param", "fatigue.dc=0.5"}}), "no fatigue goes with faces that differ"));
  EXPECT_TRUE(says(refusal_with({back, {"param", "stops=16"}}), "stops = 16 must be 8"));
  EXPECT_TRUE(says(refusal_with({back, {"param", "memory=stack"}}), "memory = stack must be stops"));
  // HB of cotton broad is 52.5/m times B: 3 times as much to the back needs 105/(1.8 m).
  EXPECT_TRUE(says(refusal_with({{"fabric.back-friction", 3}}), "needs bends of +-58"));
}

// Nobody has mistaken its unit.
TEST(FabricLimits, NameTheExperimentThatHasSetANumber) {
  Scene scene = default_scene();
  scene.fabric.density = 12;
  scene.origin["fabric.density"] = std::string(kSetBy) + "buckle: its weight grows";
  const std::vector<std::string> warnings = fabric_warnings(scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      warnings[0],
      "fabric.density = 12 kg/m^2 (set by buckle: its weight grows) is unusual: fabrics have 0.01 to 1.5 "
      "kg/m^2");
}

TEST(FabricLimits, WarnOfTheUnusualWhichRuns) {
  Scene scene = default_scene();
  EXPECT_TRUE(fabric_warnings(scene).empty());
  apply_flags(scene, {{"fabric.k0", 0.5}, {"fabric.density", 3}});
  EXPECT_NO_THROW(check_scene(scene));
  const std::vector<std::string> warnings = fabric_warnings(scene);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0],
            "fabric.density = 3 kg/m^2 (--fabric.density) is unusual: fabrics have 0.01 to 1.5 kg/m^2");
  EXPECT_TRUE(says(warnings[1], "1/cm given? Then it is 50 1/m"));
}

TEST(FabricLimits, HoldForWhatAFabricHasBeyondItsParameters) {
  Scene scene = default_scene();
  const auto warned = [&](const char* key) {
    for (const std::string& warning : fabric_warnings(scene))
      if (warning.starts_with(key)) return warning;
    return std::string();
  };
  scene.fabric.bending.branches = {{0.5, 1e9}, {0.118, 0.2}};
  scene.fabric.bending.set = {0.5, 1e-5};
  scene.fabric.in_plane.shear = {{0.02, 2}, {30, 3e6}};
  EXPECT_TRUE(says(warned("fabric.bending.branches.times"), "= 1e+09 s", "is unusual"));
  EXPECT_TRUE(says(warned("fabric.bending.branches.stiffnesses"), "= 0.118 N m",
                   "gf cm^2/cm given? Then it is 1.16e-05 N m"));
  EXPECT_TRUE(says(warned("fabric.bending.set.yield"), "1/cm given? Then it is 50 1/m"));
  EXPECT_TRUE(says(warned("fabric.membrane.stops.shear.thresholds"), "= 2 ", "% given? Then it is 0.02"));
  EXPECT_TRUE(says(warned("fabric.membrane.stops.shear.stiffnesses"), "= 3e+06 N/m"));
  EXPECT_EQ(fabric_warnings(scene).size(), 5u) << "one of a list";
  scene.fabric.bending.stops = {{20}, {0.5}};
  EXPECT_TRUE(says(warned("fabric.bending.stops.stiffnesses"), "= 0.5 N m"));
  scene.fabric.in_plane.warp = {{20}, {30}};
  EXPECT_TRUE(says(test::refusal([&] { check_fabric_numbers(scene); }),
                   "fabric.membrane.stops.warp.thresholds = 20 must be in [0, 10]"));
}

// The thresholds are 20 to 60/m in 1/cm, and in 1/km.
TEST(FabricLimits, WarnOfThresholdsInAnotherUnit) {
  Scene scene = default_scene();
  for (const double factor : {0.01, 1.0, 1000.0}) {
    scene.fabric.bending.stops = {{20 * factor, 60 * factor}, {2e-5, 1e-5}};
    const std::vector<std::string> warnings = fabric_warnings(scene);
    ASSERT_EQ(warnings.size(), factor == 1 ? 0u : 1u) << factor;
    for (const std::string& warning : warnings)
      EXPECT_TRUE(says(warning, "thresholds of bending stops from ", "not in 1/cm?"));
  }
}

TEST(FabricLimits, AreAskedByWhoHasNoScene) {
  EXPECT_TRUE(checked_fabric_warnings("cotton-broad").empty());
  EXPECT_EQ(checked_fabric_warnings("cotton-broad", {{"fabric.density", 3}, {"out", "x"}}).size(), 1u);
  EXPECT_TRUE(says(test::refusal([&] {
                     checked_fabric_warnings("cotton-broad", {{"fabric.density", 124}});
                   }),
                   "fabric.density = 124 kg/m^2 must be"));
}

TEST(FabricLimits, PassEveryFabricThatIsShipped) {
  for (const FabricFile& file : list_fabrics()) {
    Scene scene = default_scene();
    scene.fabric = file.fabric;
    EXPECT_TRUE(fabric_warnings(scene).empty()) << file.fabric.name << ": " << fabric_warnings(scene)[0];
    EXPECT_NO_THROW(check_fabric_numbers(scene)) << file.fabric.name;
  }
}

// Studies of extremes run: no bending, no friction, and bending of 1e-12 N m.
TEST(FabricLimits, LeaveExtremesToStudies) {
  Scene scene = default_scene();
  scene.fabric.b1 = scene.fabric.b2 = 0;
  scene.fabric.friction = 0;
  EXPECT_NO_THROW(check_scene(scene));
  EXPECT_TRUE(fabric_warnings(scene).empty()) << "zero stands for none";
  scene.fabric.b1 = scene.fabric.b2 = 1e-12;
  EXPECT_NO_THROW(check_scene(scene));
  EXPECT_EQ(fabric_warnings(scene).size(), 2u);
}

}  // namespace
}  // namespace hysteron
