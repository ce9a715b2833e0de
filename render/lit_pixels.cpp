#include "render/lit_pixels.h"

#include <Eigen/Core>
#include <algorithm>
#include <iterator>

#include "render/shadow_maps.h"

namespace hysteron::render {
namespace {

constexpr int kClothDepthUnit = 10, kUnevenUnit = 11;
// Uneven neighbours differ by at least this in linear light: three steps of 256 in the middle tones.
constexpr float kContrast = 0.05f, kDark = 0.001f;

bool differ(const float* a, const float* b) {
  const Eigen::Map<const Eigen::Array4f> p(a), q(b);
  return ((p - q).abs() - kContrast * p.max(q)).maxCoeff() > kDark;
}

// Returns the least area that holds every pixel that is set; one pixel where none is.
Area area_of(const std::vector<std::uint8_t>& pixels, int width, int height) {
  int left = width, right = 0, bottom = height, top = 0;
  for (int y = 0; y < height; ++y) {
    const auto row = pixels.begin() + static_cast<std::ptrdiff_t>(y) * width, end = row + width;
    const auto first = std::find(row, end, 255);
    if (first == end) continue;
    left = std::min(left, static_cast<int>(first - row));
    right = std::max(right, width - static_cast<int>(std::find(std::make_reverse_iterator(end),
                                                               std::make_reverse_iterator(row), 255) -
                                                     std::make_reverse_iterator(end)));
    bottom = std::min(bottom, y);
    top = y + 1;
  }
  if (top == 0) return {0, 0, 1, 1};
  return {left, bottom, right - left, top - bottom};
}

void take_as_it_is(const GlFunctions& gl, const GlTexture& texture) {
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

}  // namespace

LitPixels::LitPixels(const GlFunctions& gl, int width, int height)
    : gl_(&gl),
      width_(width),
      height_(height),
      depth_(filtered_texture(gl, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, width, height)),
      uneven_(gl),
      depth_target_(depth_target(gl, depth_)),
      is_uneven_(static_cast<size_t>(width) * height) {
  take_as_it_is(gl, depth_);
  take_as_it_is(gl, uneven_);
}

void LitPixels::begin_cloth() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, depth_target_.name());
  gl_->Viewport(0, 0, width_, height_);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
}

void LitPixels::bind(const Program& program, bool first_pass) const {
  bind_texture(*gl_, kClothDepthUnit, depth_);
  bind_texture(*gl_, kUnevenUnit, uneven_);
  program.set("cloth_depth", kClothDepthUnit);
  program.set("uneven", kUnevenUnit);
  program.set("first_pass", first_pass ? 1.0f : 0.0f);
}

void LitPixels::take_first(const std::vector<float>& rgba) {
  first_ = rgba;
  std::fill(is_uneven_.begin(), is_uneven_.end(), std::uint8_t{0});
  const auto compare = [&](size_t a, size_t b) {
    if (differ(&rgba[4 * a], &rgba[4 * b])) is_uneven_[a] = is_uneven_[b] = 255;
  };
  size_t i = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x, ++i) {
      if (x + 1 < width_) compare(i, i + 1);
      if (y + 1 < height_) compare(i, i + width_);
    }
  uneven_area_ = area_of(is_uneven_, width_, height_);
  gl_->BindTexture(GL_TEXTURE_2D, uneven_.name());
  gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width_, height_, 0, GL_RED, GL_UNSIGNED_BYTE, is_uneven_.data());
}

void LitPixels::complete(std::vector<float>& rgba) const {
  for (size_t i = 0; i < is_uneven_.size(); ++i)
    if (!is_uneven_[i]) std::copy_n(&first_[4 * i], 4, &rgba[4 * i]);
}

}  // namespace hysteron::render
