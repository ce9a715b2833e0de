// Films of a comparison: laid out alike from first to last, below the size that is allowed, drawn again.
#include <algorithm>

#include "render/image.h"
#include "sim/base/process.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const std::string kPage =
    "compare swing --laws linear,prandtl --compare.names 'elastic,with friction' --quick "
    "--fps 20 --seconds 0.15 --triangles 100 --size 240x180 --quality draft --device cpu "
    "--threads 1 --quiet";

class Film : public testing::Test {
 protected:
  void SetUp() override {
    if (run_process({"ffmpeg", "-version"}, "").exit_code != 0) GTEST_SKIP() << "ffmpeg is not installed";
  }
};

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
  return found;
}

// Chunks of RIFF: ANMF is a picture of an animated WebP.
TEST_F(Film, OfAComparisonHasEveryInstantAndAtMostTheBytesThatAreAllowed) {
  constexpr double kMegabytes = 0.06;
  const FinishedRun run(kPage + " --compare.video mp4,webp --compare.video-size 0.06");
  for (const char* name : {"film.mp4", "film.webp"}) {
    ASSERT_TRUE(fs::exists(run.out / name)) << name;
    EXPECT_LE(static_cast<double>(fs::file_size(run.out / name)), 1e6 * kMegabytes) << name;
  }
  const std::size_t pictures = manifest_in(run.out / "linear").at("frames").at("moments").size();
  EXPECT_EQ(pictures, 4u);
  EXPECT_EQ(count(file_content(run.out / "film.webp"), "ANMF"), pictures);
  EXPECT_TRUE(fs::exists(run.out / "film/0003.png"));
}

// Where the head stands, and how large pictures are, does not change from one picture to the next.
TEST_F(Film, IsLaidOutAlikeAndDrawnAgainFromWhatColumnsKeep) {
  constexpr int kHead = 40;  // [pixels] of names over the columns
  const FinishedRun run(kPage + " --compare.video webp");
  const render::Image first = render::read_png(run.out / "film/0000.png");
  const auto head = first.pixels().subspan(0, kHead * first.row_bytes());
  EXPECT_TRUE(std::ranges::any_of(head, [](std::uint8_t p) { return p < 128; })) << "names";
  for (const char* name : {"film/0001.png", "film/0003.png"}) {
    const render::Image image = render::read_png(run.out / name);
    ASSERT_EQ(image.height(), first.height());
    EXPECT_TRUE(std::ranges::equal(image.pixels().subspan(0, head.size()), head)) << name;
  }
  const fs::path again = run.folder.path() / "again";
  finished("render " + run.out.string() + " --render.video webp --quiet" + out_flag(again));
  for (const char* name : {"film/0000.png", "film/0003.png", "film.webp", "sheet.png"})
    EXPECT_EQ(file_content(again / name), file_content(run.out / name)) << name;

  const std::string small = " --render.video webp --render.video-size 0.0001 --quiet";
  const Outcome outcome = finished("render " + run.out.string() + small + out_flag(again));
  EXPECT_TRUE(says(outcome.err, "compare.video: there is no film.webp: "));
  EXPECT_TRUE(says(outcome.err, "and 0.0001 are allowed"));
  EXPECT_FALSE(fs::exists(again / "film.webp"));

  fs::remove(run.out / "prandtl/frames.hyg");
  EXPECT_TRUE(says(refused("render " + run.out.string() + " --render.video webp --quiet" + out_flag(again)),
                   "render.video needs all instants"));
  EXPECT_TRUE(says(
      refused("render " + (run.out / "linear").string() + " --render.video webp --quiet" + out_flag(again)),
      "render.video = webp is of comparisons"));
}

TEST(Compare, RefusesFilmsAndNamesThatCannotBe) {
  const Folder folder;
  const std::string out = out_flag(folder.path() / "out");
  EXPECT_EQ(
      refused(kPage + " --compare.video mp4,avi" + out),
      "hysteron compare: compare.video = mp4,avi must be none, or of mp4 | webp | gif, several separated by "
      "commas (--compare.video)\n");
  EXPECT_TRUE(
      says(refused(kPage + " --compare.video-size 2" + out), "compare.video-size needs --compare.video"));
  EXPECT_TRUE(
      says(refused("compare swing --laws linear,prandtl --compare.names elastic" + out),
           "compare.names = elastic must be as many names as there are columns, 2 (--compare.names)\n"));
}

}  // namespace
}  // namespace hysteron::experiments
