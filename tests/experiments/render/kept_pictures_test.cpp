// A run's folder drawn again without simulating.
#include <fstream>

#include "render/compare.h"
#include "render/image.h"
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

TEST(KeptPictures, ARunsFolderIsDrawnAgainToTheByte) {
  const Recorded swing("swing --look curvature,cloth --export usd");
  ASSERT_TRUE(fs::is_directory(swing.run / "mesh")) << "which has no meshes to be drawn";
  finished(swing.drawing(swing.run));
  for (const char* name :
       {"sheet.png", "frames/0002.png", "frames-cloth/0003.png", "frames.hyg", "sheet.hyg"})
    EXPECT_EQ(file_content(swing.again / name), file_content(swing.run / name)) << name;
}

TEST(KeptPictures, ARecordedFolderGivesItsSheetOrWhatFlagsAskFor) {
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

TEST(KeptPictures, OfAFileThatIsCutOffAreSaidToBeAPart) {
  const Recorded swing("swing");
  EXPECT_FALSE(says(finished(swing.drawing(swing.run)).err, "without the sheet"));
  const fs::path frames = swing.run / "frames.hyg";
  fs::resize_file(frames, fs::file_size(frames) - 20);
  EXPECT_TRUE(
      says(finished(swing.drawing(swing.run)).err, "and without the sheet that a whole run writes last"));
}

TEST(KeptPictures, AComparisonsFolderGivesItsSheet) {
  const Recorded page("compare swing --laws linear,prandtl --quality draft");
  finished(page.drawing(page.kept));
  EXPECT_EQ(file_content(page.again / "sheet.png"), file_content(page.run / "sheet.png"));
}

}  // namespace
}  // namespace hysteron::experiments
