// Bodies of triangles in runs: what is recorded of them, how they are found again, pictured and exported.
#include "render/compare.h"
#include "sim/mesh/mesh_export.h"
#include "sim/mesh/surface.h"
#include "sim/scene/assets.h"
#include "tests/experiments/program.h"
#include "tests/sim/mesh/bodies.h"

namespace hysteron::experiments {
namespace {

// A square that falls above a ball, which a point cache moves to the side.
class RunsWithABody : public testing::Test {
 protected:
  RunsWithABody() {
    fs::create_directories(project_);
    folder_.write("project/ball.obj", test::obj_text(ball_));
    for (int k = 0; k < 3; ++k)
      write_to_point_cache(project_ / "roll.pc2", k, ball_.moved({0.02 * k, 0, 0}).vertex);
    folder_.write("project/scene.toml", scene("sequence = \"roll.pc2\"\nfps = 20\n"));
  }

  static std::string scene(const std::string& of_body, const std::string& file = "ball.obj",
                           const std::string& center = "[0.1, 0.1, 0.1]") {
    return "mesh = \"unionjack\"\ntriangles = 32\nstep = 0.01\nseconds = 0.1\nfps = 20\n[cloth]\nshape = "
           "\"square\"\nlength = 0.2\nposition = [0, 0, 0.4]\n[[obstacle]]\nkind = \"mesh\"\nfile = \"" +
           file + "\"\ncenter = " + center + "\n" + of_body;
  }
  Outcome run_into(const fs::path& out, const std::string& flags = "") const {
    return finished("run " + (project_ / "scene.toml").string() +
                    " --quiet --threads 1 --device cpu --size 240x180" + out_flag(out) + flags);
  }
  static Outcome again(const std::string& what, const fs::path& run, const fs::path& out) {
    return finished(what + " " + run.string() + " --quiet" + out_flag(out));
  }

  const Folder folder_;
  const fs::path project_ = folder_.path() / "project", out_ = project_ / "out";
  const test::Body ball_ = test::ball(0.08, 3);
};

TEST_F(RunsWithABody, RecordItsFilesWithTheirBytes) {
  run_into(out_, " --no-images");
  const Json manifest = manifest_in(out_);
  const Json& meshes = manifest.at("meshes");
  EXPECT_EQ(meshes.at("obstacle[0].file").at("file"), (project_ / "ball.obj").string());
  EXPECT_EQ(meshes.at("obstacle[0].sequence").at("file"), (project_ / "roll.pc2").string());
  EXPECT_NE(meshes.at("obstacle[0].file").at("hash"), meshes.at("obstacle[0].sequence").at("hash"));
  EXPECT_EQ(manifest.at("inputs").at((project_ / "roll.pc2").string()),
            meshes.at("obstacle[0].sequence").at("hash"));
}

TEST_F(RunsWithABody, NameShippedFilesAsEveryMachineDoes) {
  const fs::path leg = assets_folder() / "bodies" / "leg.obj";
  folder_.write("project/scene.toml", scene("", leg.string(), "[0, 0, -2]"));  // out of the way
  run_into(out_, " --no-images");
  const std::string name = "assets/bodies/leg.obj";
  EXPECT_EQ(manifest_in(out_).at("meshes").at("obstacle[0].file").at("file"), name);
  EXPECT_EQ(manifest_in(out_).at("scene").at("obstacle").at(0).at("file"), name);
  const fs::path second = folder_.path() / "again";
  again("rerun", out_, second);
  EXPECT_EQ(manifest_in(second).at("state_hash"), manifest_in(out_).at("state_hash"));
}

TEST_F(RunsWithABody, AreRepeatedFromWhereTheFolderWasMovedTo) {
  run_into(out_, " --no-images");
  const fs::path moved = folder_.path() / "elsewhere";
  fs::rename(project_, moved);
  const fs::path second = folder_.path() / "again";
  again("rerun", moved / "out", second);
  EXPECT_EQ(manifest_in(second).at("meshes").at("obstacle[0].sequence").at("file"),
            (moved / "roll.pc2").string());
  EXPECT_EQ(manifest_in(second).at("metrics"), manifest_in(moved / "out").at("metrics"));
}

TEST_F(RunsWithABody, DoubtAFileThatHasChangedSince) {
  run_into(out_, " --no-images");
  folder_.write("project/ball.obj", test::obj_text(ball_.scaled(0.9)));
  const std::string err = again("rerun", out_, folder_.path() / "again").err;
  EXPECT_TRUE(says(err, "mesh " + (project_ / "ball.obj").string() +
                            " (obstacle[0].file) has changed since it was recorded"));
}

TEST_F(RunsWithABody, BeginAnewWithResumeWhereAFileHasChanged) {
  const auto state = [&] {
    run_into(out_, " --no-images --resume");
    const Json manifest = manifest_in(out_);
    return std::pair(manifest.at("started"), manifest.at("meshes"));
  };
  const auto first = state();
  EXPECT_EQ(state(), first) << "it is complete";
  folder_.write("project/ball.obj", test::obj_text(ball_.scaled(0.9)));
  EXPECT_NE(state().second, first.second);
}

TEST_F(RunsWithABody, HashAllFilesOfASequence) {
  for (int k : {1, 2}) folder_.write("project/f" + std::to_string(k) + ".obj", test::obj_text(ball_));
  folder_.write("project/scene.toml", scene("sequence = \"f*.obj\"\nfps = 20\n"));
  run_into(out_, " --no-images");
  const Json before = manifest_in(out_).at("meshes").at("obstacle[0].sequence");
  folder_.write("project/f2.obj", test::obj_text(ball_.moved({0.01, 0, 0})));
  run_into(project_ / "other", " --no-images");
  const Json after = manifest_in(project_ / "other").at("meshes").at("obstacle[0].sequence");
  EXPECT_EQ(before.at("file"), (project_ / "f*.obj").string());
  EXPECT_EQ(before.at("file"), after.at("file"));
  EXPECT_NE(before.at("hash"), after.at("hash"));
}

// Share of pixels that differ much.
double difference(const fs::path& a, const fs::path& b) {
  const render::Image first = render::read_png(a), second = render::read_png(b);
  EXPECT_EQ(first.width(), second.width());
  int differ = 0;
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x) differ += std::abs(first.at(x, y)[1] - second.at(x, y)[1]) > 30;
  return static_cast<double>(differ) / (first.width() * first.height());
}

const std::string kView = " --camera.box -0.1,-0.1,0,0.3,0.3,0.45";

TEST_F(RunsWithABody, ShowItWhereItIs) {
  run_into(out_, kView);
  folder_.write("project/scene.toml", scene("visible = false\n"));
  run_into(project_ / "without", kView);
  folder_.write("project/scene.toml", scene(""));
  run_into(project_ / "still", kView);
  const auto frame = [&](const char* of, int k) {
    return project_ / of / ("frames/000" + std::to_string(k) + ".png");
  };
  EXPECT_GT(difference(frame("still", 0), frame("without", 0)), 0.02) << "it is seen";
  EXPECT_EQ(difference(frame("out", 0), frame("still", 0)), 0) << "it begins where its file has it";
  EXPECT_GT(difference(frame("out", 2), frame("still", 2)), 0.002) << "it has moved by half its radius";
}

TEST_F(RunsWithABody, AreDrawnAgainToTheByteWithoutItsFiles) {
  run_into(out_, kView);
  fs::remove(project_ / "ball.obj");
  fs::remove(project_ / "roll.pc2");
  const fs::path second = folder_.path() / "again", kept = folder_.path() / "kept";
  again("render", out_, second);
  for (const char* name : {"sheet.png", "frames/0000.png", "frames/0002.png", "frames.hyg", "sheet.hyg"})
    EXPECT_TRUE(file_content(second / name) == file_content(out_ / name)) << name;
  fs::create_directories(kept);  // as results/ has it
  for (const char* name : {"manifest.json", "sheet.hyg"}) fs::copy_file(out_ / name, kept / name);
  again("render", kept, folder_.path() / "sheet");
  EXPECT_TRUE(file_content(folder_.path() / "sheet/sheet.png") == file_content(out_ / "sheet.png"));
}

TEST_F(RunsWithABody, ExportItsShapeAtEachInstantForAPathTracer) {
  run_into(out_, " --no-images --export mitsuba");
  const auto exported = [&](int k) {
    return read_surface((out_ / "mesh/bodies" / ("0000-000" + std::to_string(k) + ".ply")).string());
  };
  const Surface first = exported(0), last = exported(2);
  ASSERT_EQ(first.vertex.size(), ball_.vertex.size());
  for (std::size_t v = 0; v < first.vertex.size(); ++v)
    EXPECT_NEAR((last.vertex[v] - first.vertex[v]).x(), 0.04, 1e-6);
  EXPECT_TRUE(says(file_content(out_ / "mesh/0002.xml"), "bodies/0000-0002.ply"));
  folder_.write("project/scene.toml", scene(""));
  run_into(project_ / "still", " --no-images --export mitsuba");
  EXPECT_TRUE(says(file_content(project_ / "still/mesh/0002.xml"), "bodies/0000.ply"));
}

TEST_F(RunsWithABody, AreExplainedWithALineForIt) {
  EXPECT_TRUE(says(run_into(out_, " --explain").out,
                   "obstacle[0], mesh " + (project_ / "ball.obj").string() +
                       ": 512 triangles, 258 vertices, closed, 0.16 x 0.16 x 0.16 m, 3 frames in 0.1 s"));
}

TEST_F(RunsWithABody, WarnWhereItIsDoubtful) {
  folder_.write("project/ball.obj", test::obj_text(ball_.inside_out()));
  EXPECT_TRUE(says(run_into(out_, " --no-images").err, "warning: obstacle[0], mesh ", "face inward"));
}

}  // namespace
}  // namespace hysteron::experiments
