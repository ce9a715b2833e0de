#include "render/color_vision.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "render/lab.h"

namespace hysteron::render {
namespace {

constexpr double kToldApart = 12;  // CIEDE2000 at which thin lines are told apart
constexpr double kDegree = std::numbers::pi / 180;

// Returns the hue angle in degrees from 0 to 360.
double hue(double a, double b) {
  const double angle = std::atan2(b, a) / kDegree;
  return angle < 0 ? angle + 360 : angle;
}

// Returns the mean of two hues on their circle; if one colour is grey, the other's hue.
double mean_hue(double first, double second, bool grey) {
  if (grey) return first + second;
  const double sum = first + second;
  if (std::abs(first - second) <= 180) return sum / 2;
  return sum < 360 ? (sum + 360) / 2 : (sum - 360) / 2;
}

double turn(double from, double to, bool grey) {
  if (grey) return 0;
  const double turn = to - from;
  return turn > 180 ? turn - 360 : turn < -180 ? turn + 360 : turn;
}

double saturation(double chroma) {
  constexpr double kHalf = 6103515625;  // 25^7
  const double seventh = std::pow(chroma, 7);
  return std::sqrt(seventh / (seventh + kHalf));
}

double ciede2000(Eigen::Vector3d a, Eigen::Vector3d b) {
  const auto chroma = [](const Eigen::Vector3d& lab) { return std::hypot(lab.y(), lab.z()); };
  const double stretch = 1 + 0.5 * (1 - saturation((chroma(a) + chroma(b)) / 2));
  a.y() *= stretch;
  b.y() *= stretch;
  const double chroma_a = chroma(a), chroma_b = chroma(b), hue_a = hue(a.y(), a.z()),
               hue_b = hue(b.y(), b.z());
  const bool grey = chroma_a * chroma_b == 0;
  const double lightness = (a.x() + b.x()) / 2, c = (chroma_a + chroma_b) / 2,
               h = mean_hue(hue_a, hue_b, grey);
  const auto wave = [&](int times, double shift) { return std::cos((times * h + shift) * kDegree); };
  const double t = 1 - 0.17 * wave(1, -30) + 0.24 * wave(2, 0) + 0.32 * wave(3, 6) - 0.20 * wave(4, -63);
  const double above = (lightness - 50) * (lightness - 50), blue = (h - 275) / 25;
  const double by_lightness = (b.x() - a.x()) / (1 + 0.015 * above / std::sqrt(20 + above)),
               by_chroma = (chroma_b - chroma_a) / (1 + 0.045 * c),
               by_hue = 2 * std::sqrt(chroma_a * chroma_b) *
                        std::sin(turn(hue_a, hue_b, grey) / 2 * kDegree) / (1 + 0.015 * c * t),
               rotation = -std::sin(60 * std::exp(-blue * blue) * kDegree) * 2 * saturation(c);
  return std::sqrt(by_lightness * by_lightness + by_chroma * by_chroma + by_hue * by_hue +
                   rotation * by_chroma * by_hue);
}

Eigen::Vector3d linear_light(const Rgb8& color) {
  const auto& linear = linear_of_srgb8();
  return {linear[color[0]], linear[color[1]], linear[color[2]]};
}

const std::vector<Eigen::Matrix3d>& deficiencies() {
  static const std::vector<Eigen::Matrix3d> kAll = {
      Eigen::Matrix3d{
          {0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}},
      Eigen::Matrix3d{
          {0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}},
      Eigen::Matrix3d{
          {1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};
  return kAll;
}

Rgb8 color_named(const std::string& hex) {
  Rgb8 color{};
  for (std::size_t c = 0; c < color.size(); ++c)
    color[c] = static_cast<std::uint8_t>(std::stoi(hex.substr(1 + 2 * c, 2), nullptr, 16));
  return color;
}

}  // namespace

double color_difference(const Rgb8& a, const Rgb8& b) {
  return ciede2000(lab_of_linear(linear_light(a)), lab_of_linear(linear_light(b)));
}

double least_color_difference(const Rgb8& a, const Rgb8& b) {
  double least = color_difference(a, b);
  for (const Eigen::Matrix3d& seen : deficiencies()) {
    const auto lab = [&](const Rgb8& color) {
      return lab_of_linear((seen * linear_light(color)).cwiseMax(0.0).cwiseMin(1.0));
    };
    least = std::min(least, ciede2000(lab(a), lab(b)));
  }
  return least;
}

std::vector<int> patterns_beside(const std::vector<std::string>& colors) {
  std::vector<int> patterns;
  for (const std::string& color : colors) {
    std::set<int> taken;
    for (std::size_t before = 0; before < patterns.size(); ++before)
      if (least_color_difference(color_named(color), color_named(colors[before])) < kToldApart)
        taken.insert(patterns[before]);
    int pattern = 0;
    while (taken.contains(pattern)) ++pattern;
    patterns.push_back(pattern);
  }
  return patterns;
}

}  // namespace hysteron::render
