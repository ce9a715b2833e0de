#include "render/color_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/srgb.h"

namespace hysteron::render {
namespace {

struct Oklch {
  float lightness, chroma, hue_degree;
};

// Converts Oklab to linear sRGB (Ottosson 2020).
Eigen::Vector3f linear_srgb(const Oklch& color) {
  const float hue = color.hue_degree * std::numbers::pi_v<float> / 180;
  const float a = color.chroma * std::cos(hue), b = color.chroma * std::sin(hue);
  const float l = color.lightness + 0.3963377774f * a + 0.2158037573f * b;
  const float m = color.lightness - 0.1055613458f * a - 0.0638541728f * b;
  const float s = color.lightness - 0.0894841775f * a - 1.2914855480f * b;
  const float l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621f * l3 - 3.3077115913f * m3 + 0.2309699292f * s3,
          -1.2684380046f * l3 + 2.6097574011f * m3 - 0.3413193965f * s3,
          -0.0041960863f * l3 - 0.7034186147f * m3 + 1.7076147010f * s3};
}

bool in_gamut(const Eigen::Vector3f& color) { return color.minCoeff() >= 0 && color.maxCoeff() <= 1; }

// Gives up chroma, never lightness, where sRGB cannot show the colour.
Eigen::Vector3f shown(Oklch color) {
  while (!in_gamut(linear_srgb(color)) && color.chroma > 0.001f) color.chroma -= 0.001f;
  return linear_srgb(color).cwiseMax(0.0f).cwiseMin(1.0f);
}

// Chroma stays inside the gamut all along: 0.09 is the most that sRGB has for teal.
Oklch sequential(float t) {
  const float rise = std::clamp((t - 0.5f) / 0.4f, 0.0f, 1.0f);
  return {0.24f + 0.70f * t, 0.08f + 0.06f * rise * rise * (3 - 2 * rise), 285 - 180 * t};
}

Oklch diverging(float t) {
  const float side = 2 * t - 1, distance = std::abs(side);
  const float chroma = 0.135f * std::pow(distance, 0.8f);
  return {0.965f - 0.46f * distance, chroma, side < 0 ? 258.0f : 50.0f};
}

}  // namespace

Eigen::Vector3f map_color(ColorMap map, float t) {
  const float clamped = std::clamp(t, 0.0f, 1.0f);
  return shown(map == ColorMap::sequential ? sequential(clamped) : diverging(clamped));
}

Rgb8 map_color8(ColorMap map, float t) {
  const Eigen::Vector3f color = map_color(map, t);
  return {srgb8_of_linear(color.x()), srgb8_of_linear(color.y()), srgb8_of_linear(color.z())};
}

Rgb8 method_color(std::size_t index) {
  static constexpr Rgb8 kColors[kMethodColors] = {
      {0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {0, 0, 0}};
  return kColors[index % kMethodColors];
}

Rgb8 family_color(int family, int member, int members) {
  static constexpr float kHues[] = {255, 48, 152, 325};
  constexpr float kDark = 0.46f, kLight = 0.78f, kTurn = 18, kChroma = 0.14f;
  const float t = members > 1 ? static_cast<float>(member) / static_cast<float>(members - 1) : 0.25f;
  const Eigen::Vector3f color =
      shown({kDark + (kLight - kDark) * t, kChroma, kHues[family % 4] + kTurn * (2 * t - 1)});
  return {srgb8_of_linear(color.x()), srgb8_of_linear(color.y()), srgb8_of_linear(color.z())};
}

std::string hex(const Rgb8& color) {
  return fmt::format("#{:02X}{:02X}{:02X}", color[0], color[1], color[2]);
}

}  // namespace hysteron::render
