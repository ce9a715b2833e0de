// Whole pictures: against a stored one, and between drivers.

#include <filesystem>
#include <set>

#include "render/compare.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kPictureWidth = 320, kPictureHeight = 180;

// Drivers round differently along edges and in shadow borders; a change of shading, framing or geometry moves
// thousands of pixels by tens of steps.
constexpr double kMeanTolerance = 0.4;  // 8-bit steps
constexpr double kPixelsOver8TolerancePercent = 1.0;
// Parts against the whole: their matrices round differently, which moves a sample across an edge here and
// there (measured: 1 pixel of 57,600 by 9 steps).
constexpr double kPartsMean = 1e-3;  // 8-bit steps
constexpr double kPartsOver8Percent = 0.01;

PictureSize picture_size(int figure_passes) {
  return {.width = kPictureWidth, .height = kPictureHeight, .figure_passes = figure_passes};
}

Image picture(Offscreen& offscreen, const std::string& look, const PictureSize& size) {
  return test::draped_picture(offscreen, size, look_named(look));
}

// Calls body(offscreen, is it hardware?) for each renderer that this machine has.
template <class Body>
void on_each_renderer(const Body& body) {
  for (const Candidate& candidate : Offscreen::candidates(Renderer::automatic)) {
    std::unique_ptr<Offscreen> offscreen;
    try {
      offscreen = Offscreen::create(candidate);
    } catch (const Error&) {
      continue;
    }
    body(*offscreen, candidate.hardware);
  }
}

void expect_like_golden(const std::string& name, const Image& actual) {
  const std::filesystem::path golden =
      std::filesystem::path(HYSTERON_TEST_FOLDER) / "golden" / (name + ".png");
  const std::filesystem::path output = HYSTERON_TEST_OUTPUT;
  std::filesystem::create_directories(output);
  const auto saved = output / (name + "-actual.png");
  write_png(saved, actual, PngEffort::best);
  ASSERT_TRUE(std::filesystem::exists(golden))
      << "look at " << saved << " and accept it: cp " << saved << " " << golden;
  const Image expected = read_png(golden);
  const Difference difference = compare(actual, expected);
  const bool alike = difference.mean_abs <= kMeanTolerance &&
                     difference.pixels_over_8_percent <= kPixelsOver8TolerancePercent;
  if (alike) return;
  write_png(output / (name + "-expected.png"), expected);
  write_png(output / (name + "-heat.png"), heat_map(actual, expected));
  ADD_FAILURE() << name << ": mean difference " << difference.mean_abs << " (at most " << kMeanTolerance
                << "), pixels over 8 steps " << difference.pixels_over_8_percent << " % (at most "
                << kPixelsOver8TolerancePercent << "); compare " << name
                << "-actual.png, -expected.png and -heat.png in " << output
                << "; to accept the new picture: cp " << saved << " " << golden;
}

class GoldenPicture : public testing::TestWithParam<const char*> {};

TEST_P(GoldenPicture, LooksAsAccepted) {
  const auto offscreen = Offscreen::create(Renderer::automatic);
  expect_like_golden(std::string("drape-") + GetParam(),
                     picture(*offscreen, GetParam(), {kPictureWidth, kPictureHeight, 8, 2}));
}

INSTANTIATE_TEST_SUITE_P(Looks, GoldenPicture,
                         testing::Values("cloth", "curvature", "friction", "wireframe", "silhouette"),
                         [](const auto& look) { return look.param; });

TEST(Picture, TheSameCallsGiveTheSameBits) {
  const auto offscreen = Offscreen::create(Renderer::automatic);
  for (const int passes : {0, 4})
    EXPECT_EQ(picture(*offscreen, "cloth", picture_size(passes)),
              picture(*offscreen, "cloth", picture_size(passes)))
        << passes << " passes of a figure";
}

// The upper edge of a square, turned so that it falls by a pixel in 24 columns: every sample of a pixel is
// met in turn.
TEST(Picture, EveryRendererTakesEightSamplesOfAnEdge) {
  test::Cloth cloth = test::flat_square(1, 0.2f, 0.0f);
  for (size_t i = 0; i < cloth.positions.size(); i += 3) cloth.positions[i + 1] -= cloth.positions[i] / 24;
  int drawn = 0;
  on_each_renderer([&](Offscreen& offscreen, bool) {
    const Image image = test::cloth_view(offscreen, {120, 120}, cloth, look_named("silhouette"))
                            ->draw(Camera::top({{-0.12f, -0.12f, 0}, {0.12f, 0.12f, 0}}, 1));
    std::set<int> levels;
    for (int x = 40; x < 80; ++x)
      for (int y = 2; y < 60; ++y) levels.insert(image.at(x, y)[1]);
    EXPECT_GE(levels.size(), 9u) << offscreen.description();
    ++drawn;
  });
  EXPECT_GE(drawn, 1);
}

// Joins cannot be seen: the parts differ from the whole by the rounding of their matrices alone.
TEST(Picture, PartsMakeTheWholePicture) {
  const auto offscreen = Offscreen::create(Renderer::automatic);
  for (const char* look : {"cloth", "curvature", "wireframe"}) {
    PictureSize size{kPictureWidth, kPictureHeight};
    const Image whole = picture(*offscreen, look, size);
    size.tile = 100;  // 4 x 2 parts, of which some reach beyond the picture
    const Image parts = picture(*offscreen, look, size);
    const Difference difference = compare(whole, parts);
    EXPECT_LE(difference.pixels_over_8_percent, kPartsOver8Percent) << look;
    EXPECT_LE(difference.mean_abs, kPartsMean) << look;
  }
}

// All of Mesa's software paths run one rasteriser, so between them not a bit may differ.
struct Drawn {
  Background background;
  int figure_passes;
};
class SoftwarePicture : public testing::TestWithParam<Drawn> {};

TEST_P(SoftwarePicture, AllPathsOfOneMesaAgreeToTheBit) {
  std::vector<std::pair<std::string, Image>> pictures;
  on_each_renderer([&](Offscreen& offscreen, bool hardware) {
    const std::string name = offscreen.description();
    if (hardware || name.find("llvmpipe") == std::string::npos) return;
    Look look;
    look.background = GetParam().background;
    pictures.emplace_back(name,
                          test::draped_picture(offscreen, picture_size(GetParam().figure_passes), look));
  });
  if (pictures.size() < 2) GTEST_SKIP() << "fewer than two software paths on this machine";
  for (size_t i = 1; i < pictures.size(); ++i)
    EXPECT_EQ(pictures[i].second, pictures[0].second)
        << pictures[i].first << " against " << pictures[0].first;
}

INSTANTIATE_TEST_SUITE_P(Backgrounds, SoftwarePicture,
                         testing::Values(Drawn{Background::studio, 0}, Drawn{Background::transparent, 0},
                                         Drawn{Background::studio, 4}));

}  // namespace
}  // namespace hysteron::render
