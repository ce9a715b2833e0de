// The drawn crease angle: limbs that are fitted in the picture meet at the angle that it prints.
#include "experiments/crease/protractor.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "render/image.h"
#include "tests/experiments/program.h"
#include "tests/render/test_scene.h"

namespace hysteron::experiments {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr const char* kColor = "#366700";

// Two straight limbs of 20 mm and an arc of 6 mm radius between them, opened by so many degrees.
CreasedStrip opened(double degrees) {
  constexpr double kLimb = 20, kRadius = 6;  // [mm]
  constexpr int kParts = 100;
  CreasedStrip strip{"prandtl", kColor, {}, {}, {}};
  const auto add = [&](double x, double z) { strip.x.push_back(x), strip.z.push_back(z); };
  const double turn = std::numbers::pi - degrees * kDegree;
  for (int i = 0; i <= kParts; ++i) add(kLimb * i / kParts, 0);
  for (int i = 1; i <= kParts; ++i) {
    const double angle = turn * i / kParts;
    add(kLimb + kRadius * std::sin(angle), kRadius * (1 - std::cos(angle)));
  }
  const double x = strip.x.back(), z = strip.z.back();
  for (int i = 1; i <= kParts; ++i)
    add(x + kLimb * i / kParts * std::cos(turn), z + kLimb * i / kParts * std::sin(turn));
  strip.limbs = {{{kLimb, 0, 0}, {0, 0, 0}}, {{x, 0, z}, {strip.x.back(), 0, strip.z.back()}}};
  return strip;
}

// The heading [degree] of the pixels of the strip's thick line within `reach` pixels of a place: the axis
// along which they scatter most.
double fitted_heading(const render::Image& image, const Eigen::Vector2d& near, double reach) {
  std::vector<Eigen::Vector2d> pixels;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const std::uint8_t* p = image.at(x, y);
      const bool own = std::abs(p[0] - 0x36) < 30 && std::abs(p[1] - 0x67) < 30 && p[2] < 40;
      if (own && (Eigen::Vector2d(x, y) - near).norm() < reach) pixels.emplace_back(x, -y);
    }
  EXPECT_GT(pixels.size(), 100u);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : pixels) mean += p / static_cast<double>(pixels.size());
  double xx = 0, xy = 0, yy = 0;
  for (const auto& p : pixels) {
    const Eigen::Vector2d d = p - mean;
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
  }
  return 0.5 * std::atan2(2 * xy, xx - yy) / kDegree;
}

class Protractor : public render::test::GnuplotTest {};

bool is_red(const std::uint8_t* pixel) { return pixel[0] > 200 && pixel[1] < 60 && pixel[2] < 60; }

// The middles [pixels] of two red dots, the lower one first.
std::pair<Eigen::Vector2d, Eigen::Vector2d> red_dots(const render::Image& image) {
  std::vector<Eigen::Vector2d> red;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (is_red(image.at(x, y))) red.emplace_back(x, y);
  constexpr double kDot = 20;  // wider than one [pixels]
  Eigen::Vector2d sums[2] = {{0, 0}, {0, 0}};
  double counts[2] = {0, 0};
  for (const Eigen::Vector2d& pixel : red) {
    const int which = (pixel - red.back()).norm() < kDot ? 0 : 1;
    sums[which] += pixel;
    ++counts[which];
  }
  return {sums[0] / counts[0], sums[1] / counts[1]};
}

TEST_F(Protractor, DrawsLimbsAtTheAngleThatItPrints) {
  for (const double degrees : {76.0, 116.0, 150.0}) {
    const CreasedStrip strip = opened(degrees);
    EXPECT_NEAR(strip.limbs.opening(), degrees, 1e-9);
    render::Plot plot = protractor_plot("", {strip});
    ASSERT_EQ(plot.marks.size(), 1u);
    EXPECT_EQ(plot.marks[0].text, "prandtl " + std::to_string(static_cast<int>(degrees)) + "°");
    plot.marks.clear();  // its letters have the line's colour
    const auto halfway = [&](const Limb& limb) { return Eigen::Vector3d((limb.inner + limb.outer) / 2); };
    const Eigen::Vector3d near = halfway(strip.limbs.near), far = halfway(strip.limbs.far);
    plot.series.push_back(
        {"", {near.x(), far.x()}, {near.z(), far.z()}, render::Series::Style::points, "#FF0000"});
    render::write_plot(folder_.file("p"), plot);
    const render::Image image = render::read_png(folder_.file("p.png"));
    const auto [near_dot, far_dot] = red_dots(image);
    constexpr double kReach = 24;  // within a limb and clear of the arc [pixels]
    const double turn =
        std::remainder(fitted_heading(image, far_dot, kReach) - fitted_heading(image, near_dot, kReach), 180);
    // Axes have no sense: a turn of the strip by t is one by t - 180 degrees.
    EXPECT_NEAR(std::remainder(turn - (180 - degrees), 180), 0, 1) << degrees;
  }
}

}  // namespace
}  // namespace hysteron::experiments
