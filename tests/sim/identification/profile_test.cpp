// Moment and curvature from the profile of a sagging strip.
#include "sim/identification/profile.h"

#include <gtest/gtest.h>

#include <sstream>

#include "sim/base/error.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron {
namespace {

constexpr double kProfileDensity = 0.1238;          // [kg/m^2]
constexpr double kWeight = kProfileDensity * 9.81;  // [N/m^2]
constexpr double kEighty = 0.08;                    // [m]

// A strip clamped level, seen at `count` points.
Profile seen(const VirginCurve& curve, double length, double noise, unsigned seed, int count = 61) {
  double low = -1.57, high = 0;  // the free end's angle
  constexpr int kFine = 3000;
  std::vector<Eigen::Vector2d> strip;
  while (high - low > 1e-12) {
    const double angle = (low + high) / 2;
    strip = hanging_strip(curve, kWeight, length, {{0, 0}, angle}, kFine);
    const Eigen::Vector2d clamp = strip[1] - strip[0];
    (std::atan2(clamp.y(), clamp.x()) < 0 ? low : high) = angle;
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  Profile profile{"strip.csv", {}};
  for (int i = 0; i < count; ++i) {
    const double x = normal(random), y = normal(random);
    profile.points.push_back(strip[i * kFine / (count - 1)] - strip[0] + Eigen::Vector2d(x, y));
  }
  return profile;
}

// Small sag of a linear strip: y = -w L^4/(8 B) at the end (Timoshenko), M = w L^2/2 at the clamp.
TEST(HangingStrip, SagsByTheBeamFormulaWhereItIsStiff) {
  const double length = 0.03, b = 1e-3;
  const Profile strip = seen({b, b, 50}, length, 0, 1);
  constexpr double kClampChord = 1e-3;  // the clamp's angle is that of a chord of 1/3000 of the length
  EXPECT_NEAR(-strip.points.back().y() / (kWeight * std::pow(length, 4) / (8 * b)), 1, kClampChord);
}

// Clapp's table of a linear strip is the line M = B K.
TEST(MomentTable, OfALinearStripIsItsRigidity) {
  const double b = 2e-5;
  const MomentTable table = moment_table(smooth(seen({b, b, 50}, kEighty, 0, 1)), kWeight);
  constexpr double kSmoothing = 0.02;
  for (std::size_t i = table.curvature.size() / 2; i < table.curvature.size(); ++i)
    EXPECT_NEAR(table.moment[i] / (b * table.curvature[i]), 1, kSmoothing) << i;
}

TEST(Profile, OfAnExactStripGivesTheFabricBack) {
  const Identification found = identify_profile(seen(kCotton, kEighty, 0, 1), kProfileDensity, {});
  constexpr double kSegmentsError = 0.003;
  EXPECT_NEAR(found.b1.value / kCotton.b1, 1, kSegmentsError);
  EXPECT_NEAR(found.b2.value / kCotton.b2, 1, kSegmentsError);
  EXPECT_NEAR(found.k0.value / kCotton.k0, 1, kSegmentsError);
  EXPECT_EQ(found.undetermined(), std::vector<std::string>{});
}

TEST(Profile, WithNoiseGivesTheFabricBackWithinThreeStandardErrors) {
  constexpr double kNoise = 2e-5;  // [m]
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Identification found = identify_profile(seen(kCotton, kEighty, kNoise, seed), kProfileDensity, {});
    ASSERT_TRUE(found.undetermined().empty()) << seed;
    EXPECT_LE(std::abs(found.b1.value - kCotton.b1), 3 * found.b1.standard_error) << seed;
    EXPECT_LE(std::abs(found.b2.value - kCotton.b2), 3 * found.b2.standard_error) << seed;
    EXPECT_LE(std::abs(found.k0.value - kCotton.k0), 3 * found.k0.standard_error) << seed;
  }
}

// 3 cm of this cloth reach 15/m at the clamp.
TEST(Profile, OfAShortStripCannotTellB2FromK0) {
  const Identification found = identify_profile(seen(kCotton, 0.03, 0, 1), kProfileDensity, {});
  EXPECT_EQ(found.undetermined(), (std::vector<std::string>{"b2", "k0"}));
  constexpr double kSegmentsError = 0.003;
  EXPECT_NEAR(found.b1.value / kCotton.b1, 1, kSegmentsError);
}

TEST(Profile, SaysThatLoadingShowsNoFriction) {
  const Identification found = identify_profile(seen(kCotton, kEighty, 0, 1), kProfileDensity, {});
  EXPECT_NE(found.statements.at(0).find("was only loaded"), std::string::npos);
}

std::string refusal(const std::string& rows) {
  const test::Folder folder;
  const std::string file = folder.write("p.csv", "x [m],y [m]\n" + rows);
  return test::refusal([&] { read_profile(file, "test"); });
}

std::string csv_points(const std::vector<Eigen::Vector2d>& points) {
  std::ostringstream text;
  for (const Eigen::Vector2d& p : points) text << p.x() << "," << p.y() << "\n";
  return text.str();
}

TEST(Profile, ThatIsNoneIsRefusedWithTheReason) {
  std::vector<Eigen::Vector2d> points = seen(kCotton, kEighty, 0, 1).points;
  EXPECT_EQ(refusal(csv_points(points)), "(accepted)");
  const auto says = [](const std::string& text, const char* part) { return text.find(part) != text.npos; };
  EXPECT_TRUE(says(refusal("0,0\n0.01,-0.001\n"), "2 points, at least 12"));
  std::vector<Eigen::Vector2d> swapped = points, upwards = points, millimetres = points;
  std::swap(swapped[20], swapped[30]);
  EXPECT_TRUE(says(refusal(csv_points(swapped)), "p.csv:23")) << refusal(csv_points(swapped));
  EXPECT_TRUE(says(refusal(csv_points({points.rbegin(), points.rend()})), "from the clamp to the free end"));
  for (Eigen::Vector2d& p : upwards) p.y() = -0.1 * p.y();
  EXPECT_TRUE(says(refusal(csv_points(upwards)), "y points up")) << refusal(csv_points(upwards));
  for (Eigen::Vector2d& p : millimetres) p *= 1000;
  EXPECT_TRUE(says(refusal(csv_points(millimetres)), "x and y are metres"));
}

}  // namespace
}  // namespace hysteron
