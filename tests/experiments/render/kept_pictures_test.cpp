// A run's folder drawn again without simulating.
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
  Outcome drawn(const fs::path& from, const std::string& flags = "") const {
    return program("render " + from.string() + " --quiet" + out_flag(again) + flags);
  }
};

TEST(KeptPictures, ARunsFolderIsDrawnAgainToTheByte) {
  const Recorded swing("swing --look curvature,cloth");
  const Outcome outcome = swing.drawn(swing.run);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name :
       {"sheet.png", "frames/0002.png", "frames-cloth/0003.png", "frames.hyg", "sheet.hyg"})
    EXPECT_EQ(file_content(swing.again / name), file_content(swing.run / name)) << name;
}

TEST(KeptPictures, ARecordedFolderGivesItsSheetOrWhatFlagsAskFor) {
  const Recorded swing("swing");
  ASSERT_EQ(swing.drawn(swing.kept).exit_code, 0);
  EXPECT_EQ(file_content(swing.again / "sheet.png"), file_content(swing.run / "sheet.png"));

  ASSERT_EQ(swing.drawn(swing.kept, " --look curvature --size 160x120").exit_code, 0);
  const render::Image image = render::read_png(swing.again / "frames/0003.png");
  EXPECT_EQ(image.width(), 160);
  const Json manifest = manifest_in(swing.again);
  EXPECT_EQ(manifest.at("frames").at("looks").begin().key(), "curvature");

  const Outcome outcome = swing.drawn(swing.kept, " --look friction");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(has(outcome.err, "look = friction needs values that were not kept"));
  EXPECT_EQ(swing.drawn(swing.kept, " --render.ground 0").exit_code, 2);
}

TEST(KeptPictures, AComparisonsFolderGivesItsSheet) {
  const Recorded page("compare swing --laws linear,prandtl --quality draft");
  const Outcome outcome = page.drawn(page.kept);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(file_content(page.again / "sheet.png"), file_content(page.run / "sheet.png"));
}

}  // namespace
}  // namespace hysteron::experiments
