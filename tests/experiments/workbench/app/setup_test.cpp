#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

CommandLine drape_with(std::vector<Flag> flags) { return {"drape", "hysteron drape", std::move(flags), {}}; }

std::string setup_error(std::vector<Flag> flags) {
  return test::refusal([&] { set_up(drape_with(std::move(flags)), {default_scene(), {}}); });
}

TEST(Setup, PutsFlagsOverTheSceneFileOverTheExperimentsDefaults) {
  const Folder folder;
  const std::string file = folder.write("scene.toml", "triangles = 10\nseconds = 2\nfps = 12\nstarch = 3\n");
  experiments::Setup defaults{default_scene(), {}};
  defaults.scene.step = 5e-4;
  defaults.scene.seconds = 9;
  double starch = 0;
  const Field field = &starch;
  const Keys own = {{describe("starch", field, "g", positive(), "", "the experiment's own key"), field}};
  const auto setup =
      set_up(drape_with({{"triangles", "20"}, {"scene", file}, {"size", "64x48"}}), defaults, own);
  EXPECT_EQ(setup.scene.triangles, 20);
  EXPECT_EQ(setup.scene.seconds, 2);
  EXPECT_EQ(setup.scene.step, 5e-4);
  EXPECT_EQ(setup.options.fps, 12);
  EXPECT_EQ(starch, 3);
  EXPECT_EQ(setup.options.width(), 64);
  EXPECT_EQ(setup.options.height(), 48);
  EXPECT_EQ(setup.options.out, "out/drape");
}

TEST(Setup, PutsFlagsOverQuickOverTheSceneFile) {
  const Folder folder;
  const std::string file =
      folder.write("scene.toml", "triangles = 5000\nseconds = 9\nstarch = 7\nfps = 60\n");
  double starch = 0;
  const Field field = &starch;
  const Keys own = {{describe("starch", field, "g", positive(), "", "the experiment's own key"), field}};
  const auto quick = [&](experiments::Setup& setup) {
    setup.scene.triangles = std::min(setup.scene.triangles, 100);
    setup.scene.seconds = std::min(setup.scene.seconds, 1.0);
    setup.options.fps = std::min(setup.options.fps, 10.0);
    starch = std::min(starch, 2.0);
  };
  const std::vector<Flag> flags = {{"scene", file}, {"triangles", "300"}, {"fps", "30"}};
  std::vector<Flag> quick_flags = flags;
  quick_flags.push_back({"quick", "true"});
  const auto small = set_up(drape_with(quick_flags), {default_scene(), {}}, own, quick);
  EXPECT_EQ(small.scene.triangles, 300);
  EXPECT_EQ(small.scene.seconds, 1);
  EXPECT_EQ(small.options.fps, 30);
  EXPECT_EQ(starch, 2);
  EXPECT_EQ(set_up(drape_with(flags), {default_scene(), {}}, own, quick).scene.seconds, 9);
  quick_flags.push_back({"starch", "5"});
  set_up(drape_with(quick_flags), {default_scene(), {}}, own, quick);
  EXPECT_EQ(starch, 5);
}

TEST(Setup, OfExperimentsWithoutASceneLetsFlagsWinOverQuickToo) {
  bool is_quick = false;
  double work = 9, steps = 9;
  const Field fields[] = {&is_quick, &work, &steps};
  Keys keys;
  for (int i = 0; const char* path : {"quick", "work", "steps"})
    keys.push_back({describe(path, fields[i], "", any(), "", ""), fields[i]}), ++i;
  const auto quick = [&] { work = steps = 1; };
  set_keys(drape_with({{"steps", "5"}}), keys, quick);
  EXPECT_EQ(work, 9);
  set_keys(drape_with({{"quick", "true"}, {"steps", "5"}}), keys, quick);
  EXPECT_EQ(work, 1);
  EXPECT_EQ(steps, 5);
}

TEST(Setup, RefusesWhatNoPictureSequenceCanHave) {
  EXPECT_EQ(setup_error({{"fps", "0"}}), "fps = 0 1/s must be in (0, 10000] (--fps)");
  EXPECT_TRUE(says(setup_error({{"renderer", "vulkan"}}), "auto | egl | osmesa"));
  EXPECT_TRUE(says(setup_error({{"export", "stl"}}), "none | ply | obj | vtk | pc2"));
  EXPECT_TRUE(says(setup_error({{"camera.direction", "0 0 0"}}), "must not be zero"));
}

TEST(Setup, SaysWhoseAKeyOfItsFileIs) {
  const Folder folder;
  const std::string file = folder.write("scene.toml", "\n[crease]\nhold = 3\n");
  EXPECT_EQ(setup_error({{"scene", file}}),
            "unknown key crease.hold (" + file + ":3); it is an option of crease");
}

TEST(Setup, ChecksTheSceneAsAWhole) {
  EXPECT_TRUE(
      says(setup_error({{"fabric.b1", "1e-9"}}), "fabric.b1 = 1e-09 N m (--fabric.b1) must be >= fabric.b2"));
}

}  // namespace
}  // namespace hysteron::experiments
