// Whole pictures: against a stored one, and between drivers.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "render/compare.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr float kAspect = static_cast<float>(kWidth) / kHeight;

// Drivers round differently along edges and in shadow borders; a change of shading, framing or geometry moves
// thousands of pixels by tens of steps.
constexpr double kMeanTolerance = 0.4;  // 8-bit steps
constexpr double kPixelsOver8TolerancePercent = 1.0;

Image picture(Offscreen& offscreen, const std::string& look, int supersample) {
  const PictureSize size{kWidth, kHeight, 4, supersample};
  return test::draped_view(offscreen, size, look_named(look))->draw(test::draped_camera(kAspect));
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
  expect_like_golden(std::string("drape-") + GetParam(), picture(*offscreen, GetParam(), 2));
}

INSTANTIATE_TEST_SUITE_P(Looks, GoldenPicture,
                         testing::Values("cloth", "curvature", "friction", "wireframe", "silhouette"),
                         [](const auto& look) { return look.param; });

TEST(Picture, TheSameCallsGiveTheSameBits) {
  const auto offscreen = Offscreen::create(Renderer::automatic);
  EXPECT_EQ(picture(*offscreen, "cloth", 1), picture(*offscreen, "cloth", 1));
}

// All of Mesa's software paths run one rasteriser, so between them not a bit may differ.
TEST(Picture, AllSoftwarePathsOfOneMesaAgreeToTheBit) {
  std::vector<std::pair<std::string, Image>> pictures;
  for (const Candidate& candidate : Offscreen::candidates(Renderer::automatic)) {
    if (candidate.hardware) continue;
    try {
      const auto offscreen = Offscreen::create(candidate);
      if (offscreen->description().find("llvmpipe") == std::string::npos) continue;
      pictures.emplace_back(offscreen->description(), picture(*offscreen, "cloth", 1));
    } catch (const Error&) {
      continue;  // a path this machine lacks
    }
  }
  if (pictures.size() < 2) GTEST_SKIP() << "fewer than two software paths on this machine";
  for (size_t i = 1; i < pictures.size(); ++i)
    EXPECT_EQ(pictures[i].second, pictures[0].second)
        << pictures[i].first << " against " << pictures[0].first;
}

}  // namespace
}  // namespace hysteron::render
