#include "render/inset.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "render/srgb.h"

namespace hysteron::render {

namespace {

constexpr float kMostOfThickness = 0.35f;  // on either side: three tenths of a plate are left
// A chord of length s around an edge that turns by 60 degrees passes s/2 sin 30 = s/4 from it at most, and an
// edge that recedes by d along both its faces gives way by d (sin 30 + cos 30) across the chord.
constexpr float kEdgeShare = 0.5f / (1 + std::numbers::sqrt3_v<float>);
constexpr double kNotExceeded = 0.9;

}  // namespace

BodyMeasure::BodyMeasure(const TriangleMesh& mesh) : roundness(mesh.roundness), centred(mesh.centred) {
  Eigen::Vector3f low = mesh.positions.front(), high = low;
  for (const Eigen::Vector3f& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  half_extent = 0.5f * (high - low);
}

float long_side(std::span<const int> triangles, std::span<const float> coordinates, int dimension) {
  using Point = Eigen::Map<const Eigen::VectorXf>;
  const auto at = [&](int vertex) {
    return Point(&coordinates[static_cast<size_t>(vertex) * static_cast<size_t>(dimension)], dimension);
  };
  std::vector<float> longest;
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Point a = at(triangles[t]), b = at(triangles[t + 1]), c = at(triangles[t + 2]);
    longest.push_back(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}));
  }
  if (longest.empty()) return 0;
  const auto nth =
      longest.begin() + static_cast<std::ptrdiff_t>(kNotExceeded * static_cast<double>(longest.size()));
  std::nth_element(longest.begin(), nth, longest.end());
  return *nth;
}

float cut_depth(float side, float roundness) {
  const float edge = kEdgeShare * side;
  return roundness > 0 ? std::min(side * side / (6 * roundness), edge) : edge;
}

float body_inset(const BodyMeasure& body, float side, float least) {
  const float thickness = 2 * body.half_extent.minCoeff();
  return std::min(std::max(least, cut_depth(side, body.roundness)), kMostOfThickness * thickness);
}

namespace {

constexpr Rgb8 kPlate{255, 255, 255}, kAxis{150, 153, 158}, kGhost{176, 178, 182}, kLetter{70, 73, 78};
constexpr float kOpacity = 0.86f;  // of the white behind the loop
constexpr double kAir = 0.12;      // of the extent, beyond the largest values
constexpr float kEdge = 0.02f;     // between the inset and the picture's border, of the shorter side

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
};

float side_of(const Image& image, float share) {
  return share * static_cast<float>(std::min(image.width(), 2 * image.height()));
}

Frame frame_of(const Image& image, Corner corner, float share) {
  const float side = side_of(image, share), edge = side_of(image, kEdge);
  const bool right = corner == Corner::top_right || corner == Corner::bottom_right,
             bottom = corner == Corner::bottom_left || corner == Corner::bottom_right;
  return {right ? static_cast<float>(image.width()) - edge - side : edge,
          bottom ? static_cast<float>(image.height()) - edge - side : edge,
          side,
          {}};
}

void mix(std::uint8_t* pixel, const Rgb8& color, float share) {
  const auto& linear = linear_of_srgb8();
  for (int c = 0; c < 3; ++c)
    pixel[c] = srgb8_of_linear(linear[pixel[c]] + share * (linear[color[c]] - linear[pixel[c]]));
}

void pale(Image& image, const Frame& at) {
  const int right = std::min(image.width(), static_cast<int>(at.left + at.side)),
            bottom = std::min(image.height(), static_cast<int>(at.top + at.side));
  for (int y = std::max(0, static_cast<int>(at.top)); y < bottom; ++y)
    for (int x = std::max(0, static_cast<int>(at.left)); x < right; ++x)
      mix(image.at(x, y), kPlate, kOpacity);
}

void draw_path(Image& image, const Frame& at, const Path& path, float width, const Rgb8& color) {
  for (std::size_t i = 1; i < path.curvature.size(); ++i) {
    const float x0 = at.x(path.curvature[i - 1]), y0 = at.y(path.moment[i - 1]), x1 = at.x(path.curvature[i]),
                y1 = at.y(path.moment[i]);
    if (std::isfinite(x0 + y0 + x1 + y1)) draw_line(image, x0, y0, x1, y1, width, color);
  }
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

void draw_loop(Image& image, const LoopInset& inset, Corner corner, float share, float letters) {
  if (inset.empty()) return;
  Frame at = frame_of(image, corner, share);
  at.shown = inset.frame;
  if (at.shown.empty()) {
    at.shown.include(inset.path);
    at.shown.include(inset.reference);
  }
  give_air(at.shown.low_curvature, at.shown.high_curvature);
  give_air(at.shown.low_moment, at.shown.high_moment);
  pale(image, at);
  const float thin = std::max(1.f, at.side / 110), bold = std::max(1.5f, at.side / 40);
  draw_line(image, at.left, at.y(0), at.left + at.side, at.y(0), thin, kAxis);
  draw_line(image, at.x(0), at.top, at.x(0), at.top + at.side, thin, kAxis);
  const bool left = at.x(0) - at.left > at.side / 2;  // of which there is more room
  const bool below = at.y(0) - at.top < at.side / 2;
  draw_text(image, "M", left ? at.x(0) - 1.3f * letters : at.x(0) + 0.35f * letters,
            below ? at.top + at.side : at.top + letters, {kLetter, letters});
  draw_text(image, "κ", left ? at.left : at.left + at.side - text_width("κ", letters),
            at.y(0) - 0.4f * letters, {kLetter, letters});
  draw_path(image, at, inset.reference, bold, kGhost);
  draw_path(image, at, inset.path, bold, inset.color);
  const float x = at.x(inset.path.curvature.back()), y = at.y(inset.path.moment.back());
  if (std::isfinite(x + y)) {
    draw_line(image, x, y, x, y, 4.6f * bold, kPlate);
    draw_line(image, x, y, x, y, 3.4f * bold, inset.color);
  }
}

}  // namespace hysteron::render
