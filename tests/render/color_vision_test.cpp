#include "render/color_vision.h"

#include <gtest/gtest.h>

namespace hysteron::render {
namespace {

// A dark red and a dark green whose differences another program gave: for deuteranopes they are one colour.
TEST(ColorVision, TellsRedFromGreenBetterThanADeuteranopeDoes) {
  const Rgb8 red{0x97, 0x30, 0x23}, green{0x36, 0x67, 0x00};
  EXPECT_NEAR(color_difference(red, green), 51.7, 0.05);
  EXPECT_NEAR(least_color_difference(red, green), 2.1, 0.05);
}

TEST(ColorVision, DifferencesAreZeroOfOneColourAndAHundredFromBlackToWhite) {
  const Rgb8 blue{0, 114, 178};
  EXPECT_EQ(color_difference(blue, blue), 0);
  EXPECT_NEAR(color_difference({0, 0, 0}, {255, 255, 255}), 100, 1e-3);
  EXPECT_NEAR(color_difference(blue, {0, 158, 115}), color_difference({0, 158, 115}, blue), 1e-12);
}

TEST(ColorVision, GivesAPatternOfItsOwnToWhatCannotBeToldApartByColour) {
  EXPECT_EQ(patterns_beside({"#973023", "#0072B2", "#366700", "#973023", "#0072B2"}),
            (std::vector<int>{0, 0, 1, 2, 1}));
  EXPECT_TRUE(patterns_beside({}).empty());
}

}  // namespace
}  // namespace hysteron::render
