// Pictures frame their cloth: none shows it cut off, and none is empty.
#include <array>
#include <cmath>
#include <fstream>

#include "experiments/workbench/app/camera_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pictures/archived_instants.h"
#include "render/image.h"
#include "sim/base/error.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const std::string kSmall = " --device cpu --threads 1 --size 240x135 --fps 10 --quiet ";

struct Case {
  const char* name;
  const char* line;
};

// The frame does not depend on how the picture is drawn.
const char* const kDraft = "--quality draft ";

class PicturesOf : public testing::TestWithParam<Case> {};

// Shares of each picture that its cloth reaches from and to: within, and not lost in it.
TEST_P(PicturesOf, TheirClothIsWholeAndNotSmall) {
  const FinishedRun run(std::string(GetParam().line) + kSmall + kDraft);
  EXPECT_FALSE(says(run.outcome.err, "cut off"));
  const Manifest manifest = read_manifest(run.out / "manifest.json");
  double widest = 0, highest = 0;
  for (const Frames::Instant& instant : manifest.frames.value().instants) {
    const std::array<double, 4>& at = instant.cloth;
    EXPECT_GE(std::min(at[0], at[1]), 0) << "t = " << instant.time;
    EXPECT_LE(std::max(at[2], at[3]), 1) << "t = " << instant.time;
    widest = std::max(widest, at[2] - at[0]);
    highest = std::max(highest, at[3] - at[1]);
  }
  EXPECT_GE(std::max(widest, highest), 0.5) << "of a picture, in the instant that fills most of it";
}

INSTANTIATE_TEST_SUITE_P(Experiments, PicturesOf,
                         testing::Values(Case{"swing", "swing --triangles 60 --seconds 0.3"},
                                         Case{"crease", "crease --quick --triangles 100"},
                                         Case{"rod", "crease --quick --crease.fold rod --triangles 100"},
                                         Case{"fold", "fold --quick --triangles 100 --fold.cycles 1"},
                                         Case{"drape", "drape --quick --triangles 200"}),
                         [](const testing::TestParamInfo<Case>& one) { return std::string(one.param.name); });

// The file that a run writes makes another run's pictures the same to the bit.
TEST(CameraFile, GivesTheSamePicturesAgain) {
  const std::string line = "swing --triangles 60 --seconds 0.2" + kSmall;
  const FinishedRun a(line + " --camera.direction 1,-1,0.3"),
      b(line + " --camera " + (a.out / "camera.json").string());
  const render::Image first = render::read_png(a.out / "frames/0002.png"),
                      second = render::read_png(b.out / "frames/0002.png");
  ASSERT_EQ(first.pixels().size(), second.pixels().size());
  int apart = 0;
  for (std::size_t i = 0; i < first.pixels().size(); ++i)
    apart = std::max(apart, std::abs(first.pixels()[i] - second.pixels()[i]));
  EXPECT_LE(apart, 48) << "numbers of the file have the precision of the camera's: edges may move by a bit";
}

TEST(CameraFile, IsRefusedWhereItIsNone) {
  const Folder folder;
  const fs::path file = folder.path() / "camera.json";
  Options options;
  EXPECT_THROW(read_camera(file.string(), options), Error);
  for (const char* text : {"{", "{}", R"({"camera": {"fov": "wide"}})", R"({"camera": {"zoom": 2}})",
                           R"({"camera": {"direction": [1, 2]}})", R"({"camera": {"fov": 0}})"}) {
    std::ofstream(file) << text;
    EXPECT_THROW(read_camera(file.string(), options), Error) << text;
  }
  std::ofstream(file) << R"({"camera": {"fov": 30, "target": [0, 0, 1]}})";
  read_camera(file.string(), options);
  EXPECT_EQ(options.camera_fov, 30);
  EXPECT_EQ(options.camera_target, (Numbers{0, 0, 1}));
}

// Instants without motion are dropped first; the first and the last stay.
TEST(ArchivedInstants, KeepThoseThatMove) {
  ArchivedInstants kept;
  for (int i = 0; i < 200; ++i) {
    const float x = static_cast<float>(std::min(i, 100));  // then it is at rest
    EXPECT_NEAR(kept.add({1.0 * i, {x, 0, 0, x, 0, 0}, {}, "", {}}), i > 0 && i <= 100, 1e-6);
  }
  ASSERT_LE(kept.all().size(), 48u);
  EXPECT_EQ(kept.all().front().time, 0);
  EXPECT_EQ(kept.last().time, 199);
  const std::vector<ArchivedInstant> chosen = kept.chosen(5);
  ASSERT_EQ(chosen.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(chosen[i].xyz[0], 25.0 * i, 4) << i;
}

}  // namespace
}  // namespace hysteron::experiments
