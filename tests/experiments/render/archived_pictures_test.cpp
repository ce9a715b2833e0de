// A run's folder is drawn again without simulating.
#include <fmt/core.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "render/compare.h"
#include "render/image.h"
#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const std::string kSmall = " --quick --fps 10 --seconds 0.3 --size 240x180 --device cpu --quiet";

// A folder as results/ has it: no frames.
struct Recorded {
  Folder folder;
  fs::path run = folder.path() / "run", kept = folder.path() / "kept", again = folder.path() / "again";

  explicit Recorded(const std::string& command) {
    finished(command + kSmall + out_flag(run));
    fs::create_directories(kept);
    for (const char* name : {"manifest.json", "sheet.hyg"}) fs::copy_file(run / name, kept / name);
  }
  std::string drawing(const fs::path& from, const std::string& flags = "") const {
    return "render " + from.string() + " --quiet" + out_flag(again) + flags;
  }
};

TEST(ArchivedPictures, ARunsFolderIsDrawnAgainToTheByte) {
  const Recorded swing("swing --look curvature,cloth --export usd");
  ASSERT_TRUE(fs::is_directory(swing.run / "mesh")) << "which has no meshes to be drawn";
  finished(swing.drawing(swing.run));
  for (const char* name :
       {"sheet.png", "frames/0002.png", "frames-cloth/0003.png", "frames.hyg", "sheet.hyg"})
    EXPECT_EQ(file_content(swing.again / name), file_content(swing.run / name)) << name;
}

TEST(ArchivedPictures, ARecordedFolderGivesItsSheetOrWhatFlagsAskFor) {
  const Recorded swing("swing");
  finished(swing.drawing(swing.kept));
  EXPECT_EQ(file_content(swing.again / "sheet.png"), file_content(swing.run / "sheet.png"));

  finished(swing.drawing(swing.kept, " --look curvature --render.range 50 --size 160x120"));
  const render::Image image = render::read_png(swing.again / "frames/0003.png");
  EXPECT_EQ(image.width(), 160);
  const Json manifest = manifest_in(swing.again);
  EXPECT_EQ(manifest.at("frames").at("looks").begin().key(), "curvature");

  EXPECT_TRUE(says(refused(swing.drawing(swing.kept, " --look friction")),
                   "look = friction needs values that were not kept"));
  refused(swing.drawing(swing.kept, " --render.ground 0"));
  EXPECT_TRUE(says(refused(swing.drawing(swing.kept, " --render.range 50")),
                   "--render.range 50 is not used: render.range needs --look curvature (look = cloth)"));
}

TEST(ArchivedPictures, OfAFileThatIsCutOffAreSaidToBeAPart) {
  const Recorded swing("swing");
  EXPECT_FALSE(says(finished(swing.drawing(swing.run)).err, "without the sheet"));
  const fs::path frames = swing.run / "frames.hyg";
  fs::resize_file(frames, fs::file_size(frames) - 20);
  EXPECT_TRUE(
      says(finished(swing.drawing(swing.run)).err, "and without the sheet that a whole run writes last"));
}

TEST(ArchivedPictures, AComparisonsFolderGivesItsSheet) {
  const Recorded page("compare swing --laws linear,prandtl --quality draft");
  finished(page.drawing(page.kept));
  EXPECT_EQ(file_content(page.again / "sheet.png"), file_content(page.run / "sheet.png"));
  finished(page.drawing(page.kept, " --render.title Swings"));
  EXPECT_NE(file_content(page.again / "sheet.png"), file_content(page.run / "sheet.png"));
}

// An OBJ of a square of 0.2 m whose right half is rippled, straight across, by this amplitude [m].
std::string half_rippled(double amplitude) {
  constexpr int kCells = 40;
  constexpr double kEdge = 0.2 / kCells, kWave = 0.02;
  std::string text;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const double beyond = std::max(0.0, i * kEdge - 0.1);
      text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", i * kEdge, j * kEdge,
                          amplitude * std::sin(2 * std::numbers::pi * beyond / kWave));
    }
  for (int i = 0; i < kCells; ++i)
    for (int j = 1; j <= kCells; ++j) {
      const int a = i * (kCells + 1) + j, b = a + kCells + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
    }
  return text;
}

// It is held as it starts, with a metric of each half.
class PartRelief : public testing::Test {
 protected:
  PartRelief() {
    folder_.write("flat.obj", half_rippled(0));
    folder_.write("rippled.obj", half_rippled(1.5e-3));
    const std::string scene =
        folder_.write("scene.toml",
                      "step = 0.01\nseconds = 0.02\n[cloth]\nshape = \"file\"\nfile = \"flat.obj\"\nstart = "
                      "\"rippled.obj\"\n"
                      "[[pin]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 1]\n[camera]\ndirection = [0, -0.3, 1]\n"
                      "[[metric]]\nname = \"flat\"\nkind = \"residual-curvature\"\nhigh = [0.095, 1, 1]\n"
                      "[[metric]]\nname = \"rippled\"\nkind = \"ridge-height\"\nlow = [0.105, -1, -1]\n"
                      "[[metric]]\nname = \"corner\"\nkind = \"height\"\n");
    finished("run " + scene + " --size 320x320 --fps 100 --threads 1 --device cpu --quiet" + out_flag(run_));
  }
  std::string drawing(const std::string& flags) const {
    return "render " + run_.string() + " --light raking --quiet" + out_flag(out_) + " --render.part " + flags;
  }
  double deviation(const std::string& part) const {
    finished(drawing(part));
    const Json metrics = metrics_of(out_);
    EXPECT_EQ(metrics.at("lightness_deviation_added"), 0) << "it is held";
    return metrics.at("lightness_deviation");
  }

  const Folder folder_;
  const fs::path run_ = folder_.path() / "run", out_ = folder_.path() / "out";
};

TEST_F(PartRelief, IsOfTheMetricsPartAlone) {
  const double flat = deviation("flat"), rippled = deviation("rippled");
  EXPECT_LT(flat, 3) << "its threads";
  EXPECT_GT(rippled, flat + 5);
  const Table table = read_table(out_ / "lightness.csv");
  EXPECT_EQ(table.numbers("time [s]"), (std::vector<double>{0, 0.02}));
  EXPECT_EQ(table.numbers("lightness_deviation")[1], table.numbers("lightness_deviation")[0]);
  // Half of the square is seen as half of it, but for 10 pixels along its border.
  const render::Image shown = render::read_png(out_ / "part-1.png");
  const double seen = table.numbers("pixels")[0] / (shown.width() * shown.height());
  EXPECT_GT(seen, 0.2);
  EXPECT_LT(seen, 0.5);
}

TEST_F(PartRelief, IsRefusedWhereThereIsNone) {
  EXPECT_TRUE(
      says(refused(drawing("ripled")), "must be flat | rippled (--render.part; did you mean rippled?)"));
  EXPECT_TRUE(says(refused(drawing("corner")), "render.part = corner must be flat | rippled"));
  EXPECT_TRUE(
      says(refused(drawing("rippled --camera.direction \"0 1 0\"")), "has 0 pixels with nothing but cloth"));
  EXPECT_TRUE(says(refused("render " + folder_.file("flat.obj") + " --render.part flat" + out_flag(out_)),
                   "it is of a run's folder, not of files"));
}

}  // namespace
}  // namespace hysteron::experiments
