#include "render/loop_inset.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/plot.h"
#include "render/srgb.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kPlate{255, 255, 255}, kAxis{150, 153, 158}, kGhost{176, 178, 182}, kAxisName{70, 73, 78};
constexpr float kOpacity = 0.86f;  // opacity of the white behind the loop
constexpr double kAir = 0.12;      // room beyond the largest values, over the extent
constexpr float kEdge = 0.02f;     // distance from the picture's border, over the shorter side

struct Frame {
  float left, top, side;  // [pixels]
  LoopFrame shown;
  float x(double k) const {
    return left + side * static_cast<float>((k - shown.low_curvature) /
                                            (shown.high_curvature - shown.low_curvature));
  }
  float y(double m) const {
    return top + side * static_cast<float>((shown.high_moment - m) / (shown.high_moment - shown.low_moment));
  }
  bool holds(float px, float py) const {
    return px >= left && px <= left + side && py >= top && py <= top + side;
  }
};

float inset_width(const Image& image, float fraction) {
  return fraction * static_cast<float>(std::min(image.width(), 2 * image.height()));
}

Frame inset_frame(const Image& image, Corner corner, float fraction) {
  const float side = inset_width(image, fraction), edge = inset_width(image, kEdge);
  return {is_right(corner) ? static_cast<float>(image.width()) - edge - side : edge,
          is_bottom(corner) ? static_cast<float>(image.height()) - edge - side : edge,
          side,
          {}};
}

void mix(std::uint8_t* pixel, const Rgb8& color, float fraction) {
  const auto& linear = linear_of_srgb8();
  for (int c = 0; c < 3; ++c)
    pixel[c] = srgb8_of_linear(linear[pixel[c]] + fraction * (linear[color[c]] - linear[pixel[c]]));
}

void pale(Image& image, const Frame& at) {
  const int right = std::min(image.width(), static_cast<int>(at.left + at.side)),
            bottom = std::min(image.height(), static_cast<int>(at.top + at.side));
  for (int y = std::max(0, static_cast<int>(at.top)); y < bottom; ++y)
    for (int x = std::max(0, static_cast<int>(at.left)); x < right; ++x)
      mix(image.at(x, y), kPlate, kOpacity);
}

// Clips a line to the frame (Liang & Barsky 1984); false if no part of it is within.
bool clip(const Frame& at, float& x0, float& y0, float& x1, float& y1) {
  const float dx = x1 - x0, dy = y1 - y0;
  const std::array<std::array<float, 2>, 4> sides{
      {{-dx, x0 - at.left}, {dx, at.left + at.side - x0}, {-dy, y0 - at.top}, {dy, at.top + at.side - y0}}};
  float enters = 0, leaves = 1;
  for (const auto& [change, room] : sides) {
    if (change == 0 && room < 0) return false;
    if (change < 0) enters = std::max(enters, room / change);
    if (change > 0) leaves = std::min(leaves, room / change);
  }
  if (enters > leaves) return false;
  x1 = x0 + leaves * dx, y1 = y0 + leaves * dy;
  x0 += enters * dx, y0 += enters * dy;
  return true;
}

void draw_path(Image& image, const Frame& at, const Path& path, float width, const Rgb8& color) {
  for (std::size_t i = 1; i < path.curvature.size(); ++i) {
    float x0 = at.x(path.curvature[i - 1]), y0 = at.y(path.moment[i - 1]), x1 = at.x(path.curvature[i]),
          y1 = at.y(path.moment[i]);
    if (std::isfinite(x0 + y0 + x1 + y1) && clip(at, x0, y0, x1, y1))
      draw_line(image, x0, y0, x1, y1, width, color);
  }
}

// Returns the tick of an axis, 1, 2 or 5 times a power of ten, most of the way to the end that is farther
// from zero.
double tick(double low, double high) {
  constexpr double kMost = 0.9;
  const double end = std::abs(low) > std::abs(high) ? low : high, most = kMost * std::abs(end),
               decade = std::pow(10, std::floor(std::log10(most)));
  return std::copysign((most >= 5 * decade ? 5 : most >= 2 * decade ? 2 : 1) * decade, end);
}

// The tick of an axis and its text.
struct AxisName {
  double at;
  std::string text;
};

AxisName curvature_name(const LoopFrame& shown) {
  const double at = tick(shown.low_curvature, shown.high_curvature);
  return {at, fmt::format("κ = {:g} /m", at)};
}

AxisName moment_name(const LoopFrame& shown) {
  const double at = tick(shown.low_moment, shown.high_moment);
  const auto [prefix, factor] = si_prefix(at);
  return {at, fmt::format("M = {:.3g} {}N", at / factor, prefix)};
}

// Names stand where loops are not: κ's is below its axis where values are positive, above it where they are
// negative; M's is beyond the end of its axis.
void leave_room_for_names(Frame& at, float letters) {
  const float high = 1.6f * letters, y = at.y(0) - at.top;
  const bool right = curvature_name(at.shown).at > 0, up = moment_name(at.shown).at > 0;
  const float above = std::max(up ? high : 0, right ? 0 : std::max(0.f, high - y)),
              below = std::max(up ? 0 : high, right ? std::max(0.f, high - at.side + y) : 0);
  at.top += above;
  at.side -= above + below;
  if (right) return;
  at.left += above + below;  // M's axis stays at the border
}

void name_axes(Image& image, const Frame& at, float letters) {
  const AxisName k = curvature_name(at.shown), m = moment_name(at.shown);
  const float half = 0.25f * letters, thin = std::max(1.f, at.side / 110);
  const float x = at.x(k.at), y = at.y(m.at);
  draw_line(image, x, at.y(0) - half, x, at.y(0) + half, thin, kAxisName);
  draw_line(image, at.x(0) - half, y, at.x(0) + half, y, thin, kAxisName);
  const auto write = [&](const std::string& text, float middle, float base) {
    const float wide = text_width(text, letters), most = static_cast<float>(image.width()) - wide;
    draw_text(image, text, std::clamp(middle - wide / 2, 0.f, std::max(0.f, most)), base,
              {kAxisName, letters});
  };
  write(k.text, x, at.y(0) + (k.at > 0 ? 1.5f : -0.5f) * letters);
  write(m.text, at.x(0), m.at > 0 ? at.top - 0.4f * letters : at.top + at.side + 1.4f * letters);
}

void include(double& low, double& high, const std::vector<double>& values) {
  for (double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
}

void give_air(double& low, double& high) {
  if (low == high) low -= 1, high += 1;
  const double air = kAir * (high - low);
  low -= air;
  high += air;
}

}  // namespace

void LoopFrame::include(const Path& path) {
  render::include(low_curvature, high_curvature, path.curvature);
  render::include(low_moment, high_moment, path.moment);
}

LoopFrame LoopFrame::of_most(const std::vector<LoopFrame>& frames) {
  constexpr double kReach = 3;
  LoopFrame all;
  const auto farther = [](double a, double b) { return std::abs(a) < std::abs(b); };
  // Sets both ends of an axis.
  const auto take = [&](double LoopFrame::*low, double LoopFrame::*high) {
    std::vector<double> ends[2];
    for (const LoopFrame& frame : frames) ends[0].push_back(frame.*low), ends[1].push_back(frame.*high);
    double most = 0;
    for (std::vector<double>& side : ends) {
      std::ranges::sort(side, farther);
      if (!side.empty()) most = std::max(most, kReach * std::abs(side[side.size() / 2]));
    }
    for (int i = 0; i < 2; ++i) {
      while (!ends[i].empty() && std::abs(ends[i].back()) > most) ends[i].pop_back();
      if (!ends[i].empty()) all.*(i == 0 ? low : high) = ends[i].back();
    }
  };
  take(&LoopFrame::low_curvature, &LoopFrame::high_curvature);
  take(&LoopFrame::low_moment, &LoopFrame::high_moment);
  return all;
}

bool names_loop_axes(float side, float letters) {
  constexpr float kLeast = 8;  // least side, in letters
  return side >= kLeast * letters;
}

void draw_line(Image& image, float x0, float y0, float x1, float y1, float width, const Rgb8& color) {
  const float half = width / 2, dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  const auto from = [&](float a, float b) { return static_cast<int>(std::floor(std::min(a, b) - half - 1)); };
  const auto to = [&](float a, float b) { return static_cast<int>(std::ceil(std::max(a, b) + half + 1)); };
  for (int y = std::max(0, from(y0, y1)); y < std::min(image.height(), to(y0, y1)); ++y)
    for (int x = std::max(0, from(x0, x1)); x < std::min(image.width(), to(x0, x1)); ++x) {
      const float px = static_cast<float>(x) + 0.5f - x0, py = static_cast<float>(y) + 0.5f - y0;
      const float t = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.f, 1.f) : 0;
      const float cover = half + 0.5f - std::hypot(px - t * dx, py - t * dy);
      if (cover > 0) mix(image.at(x, y), color, std::min(cover, 1.f));
    }
}

void draw_loop(Image& image, const LoopInset& inset, Corner corner, float fraction, float letters) {
  if (inset.empty()) return;
  Frame at = inset_frame(image, corner, fraction);
  at.shown = inset.frame;
  if (at.shown.empty()) {
    at.shown.include(inset.path);
    at.shown.include(inset.reference);
  }
  give_air(at.shown.low_curvature, at.shown.high_curvature);
  give_air(at.shown.low_moment, at.shown.high_moment);
  pale(image, at);
  const bool named = names_loop_axes(at.side, letters);
  if (named) leave_room_for_names(at, letters);
  const float thin = std::max(1.f, at.side / 110), bold = std::max(1.5f, at.side / 40);
  draw_line(image, at.left, at.y(0), at.left + at.side, at.y(0), thin, kAxis);
  draw_line(image, at.x(0), at.top, at.x(0), at.top + at.side, thin, kAxis);
  if (named) name_axes(image, at, letters);
  draw_path(image, at, inset.reference, bold, kGhost);
  draw_path(image, at, inset.path, bold, inset.color);
  const float x = at.x(inset.path.curvature.back()), y = at.y(inset.path.moment.back());
  if (std::isfinite(x + y) && at.holds(x, y)) {
    draw_line(image, x, y, x, y, 4.6f * bold, kPlate);
    draw_line(image, x, y, x, y, 3.4f * bold, inset.color);
  }
}

}  // namespace hysteron::render
