#include <sstream>

#include "experiments/workbench/app/scene_source.h"
#include "sim/scene/assets.h"
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
  const Keys own = {{describe("starch", field, "g", positive(), "the experiment's own key"), field}};
  const auto setup =
      set_up(drape_with({{"triangles", 20}, {"scene", file}, {"size", "64x48"}}), defaults, own);
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
  const Keys own = {{describe("starch", field, "g", positive(), "the experiment's own key"), field}};
  const auto quick = [&](experiments::Setup& setup) {
    setup.scene.triangles = std::min(setup.scene.triangles, 100);
    setup.scene.seconds = std::min(setup.scene.seconds, 1.0);
    setup.options.fps = std::min(setup.options.fps, 10.0);
    starch = std::min(starch, 2.0);
  };
  const std::vector<Flag> flags = {{"scene", file}, {"triangles", 300}, {"fps", 30}};
  std::vector<Flag> quick_flags = flags;
  quick_flags.push_back({"quick", true});
  const auto small = set_up(drape_with(quick_flags), {default_scene(), {}}, own, quick);
  EXPECT_EQ(small.scene.triangles, 300);
  EXPECT_EQ(small.scene.seconds, 1);
  EXPECT_EQ(small.options.fps, 30);
  EXPECT_EQ(starch, 2);
  EXPECT_EQ(set_up(drape_with(flags), {default_scene(), {}}, own, quick).scene.seconds, 9);
  quick_flags.push_back({"starch", 5});
  set_up(drape_with(quick_flags), {default_scene(), {}}, own, quick);
  EXPECT_EQ(starch, 5);
}

TEST(Setup, OfExperimentsWithoutASceneLetsFlagsWinOverQuickToo) {
  bool is_quick = false;
  double work = 9, steps = 9;
  const Field fields[] = {&is_quick, &work, &steps};
  Keys keys;
  for (int i = 0; const char* path : {"quick", "work", "steps"})
    keys.push_back({describe(path, fields[i], "", any(), ""), fields[i]}), ++i;
  const auto quick = [&] { work = steps = 1; };
  set_keys(drape_with({{"steps", 5}}), keys, quick);
  EXPECT_EQ(work, 9);
  set_keys(drape_with({{"quick", true}, {"steps", 5}}), keys, quick);
  EXPECT_EQ(work, 1);
  EXPECT_EQ(steps, 5);
}

TEST(Setup, RefusesWhatNoPictureSequenceCanHave) {
  EXPECT_EQ(setup_error({{"fps", -1}}), "fps = -1 1/s must be in [0, 10000] (--fps)");
  EXPECT_TRUE(says(setup_error({{"renderer", "vulkan"}}), "auto | egl | osmesa"));
  EXPECT_TRUE(says(setup_error({{"export", "stl"}}), "none | ply | obj | vtk | pc2 | usd | glb"));
  EXPECT_TRUE(says(setup_error({{"camera.direction", Numbers{0, 0, 0}}}), "must not be zero"));
}

TEST(Setup, SaysWhoseAKeyOfItsFileIs) {
  const Folder folder;
  const std::string file = folder.write("scene.toml", "\n[crease]\nhold = 3\n");
  EXPECT_EQ(setup_error({{"scene", file}}),
            "unknown key crease.hold (" + file + ":3); it is an option of crease");
}

TEST(Setup, ChecksTheSceneAsAWhole) {
  EXPECT_TRUE(
      says(setup_error({{"fabric.b1", 1e-9}}), "fabric.b1 = 1e-09 N m (--fabric.b1) must be >= fabric.b2"));
}

// Returns the values of a dumped scene, without the comments, which tell where each value comes from.
std::string dumped_values(const std::string& file) {
  std::istringstream lines(file_content(file));
  std::string values;
  for (std::string line; std::getline(lines, line);) values += line.substr(0, line.find("  # ")) + "\n";
  return values;
}

// Resolves the scene as `run` does and dumps it.
void dump_as(const std::string& scene, const std::string& file) {
  experiments::Setup defaults{default_scene(), {}};
  defaults.own_tables = {"metric"};
  dump_scene(set_up({"run", "hysteron run", {{"scene", scene}, {"dump-scene", file}}, {}}, defaults));
}

TEST(DumpedScene, IsReadAgainAndSaysTheSame) {
  const Folder folder;
  const std::string mesh = folder.write("m.obj",
                                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"),
                    once = folder.file("once.toml"), again = folder.file("again.toml");
  std::vector<std::string> scenes = list_assets("scenes");
  ASSERT_GT(scenes.size(), 5u);
  const std::string cloth = "[cloth]\nshape = \"file\"\nfile = \"" + mesh + "\"\n";
  const std::string rest =
      "seconds = 2\nlaw = \"grinspun-edit\"\n" + cloth + "start = \"" + mesh +
      "\"\nunit = \"centimetre\"\nweld = 1e-4\n"
      "[[phase]]\nname = \"hang\"\n[[phase]]\nname = \"fall\"\n"
      "[[pin]]\nselect = \"nearest\"\nuntil = \"fall\"\nkeys = [{time = 0.5, position = [0, 0, 1]}]\n"
      "[[obstacle]]\nkind = \"torus\"\nfrom = 1\n[[command]]\nkind = \"edit\"\ntime = 1\n";
  scenes.push_back(folder.write("file.toml", rest));
  scenes.push_back(folder.write("pattern.toml", "[cloth]\nshape = \"pattern\"\nfile = \"" + mesh + "\"\n"));
  scenes.push_back(folder.write("mesh.toml", "mesh = \"" + mesh + "\"\n[param]\nmemory = \"stops\"\n"));
  for (const std::string& scene : scenes) {
    dump_as(scene, once);
    dump_as(once, again);
    EXPECT_EQ(dumped_values(once), dumped_values(again)) << scene;
  }
}

}  // namespace
}  // namespace hysteron::experiments
