#include <algorithm>
#include <cmath>
#include <vector>

#include "render/caption.h"
#include "render/shaders/embedded.h"
#include "render/srgb.h"
#include "sim/base/error.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace hysteron::render {
namespace {

// DejaVu Sans: a capital is 0.729 of the em (its OS/2 table's cap height, 1493 of 2048 units).
constexpr float kCapitalOfEm = 0.729f;

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo record = [] {
    const auto bytes = embedded_file("DejaVuSans.ttf");
    stbtt_fontinfo result;
    if (!stbtt_InitFont(&result, bytes.data(), stbtt_GetFontOffsetForIndex(bytes.data(), 0)))
      throw Error::system("reading DejaVuSans.ttf: not a TrueType font; set HYSTERON_FONT and build again");
    return result;
  }();
  return record;
}

float font_scale(float size) { return stbtt_ScaleForMappingEmToPixels(&font(), size / kCapitalOfEm); }

// Takes the next code point of UTF-8 text; a broken sequence counts byte by byte.
int next_code_point(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
  if (length > text.size()) {
    text.remove_prefix(1);
    return first;
  }
  int code = length == 1 ? first : first & (0x7F >> length);
  for (size_t i = 1; i < length; ++i) code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3F);
  text.remove_prefix(length);
  return code;
}

// Calls place(glyph, x) for each letter, x from 0 with kerning, in pixels; returns the end.
template <class Place>
float for_each_glyph(std::string_view text, float scale, const Place& place) {
  float x = 0;
  int previous = 0;
  while (!text.empty()) {
    const int glyph = stbtt_FindGlyphIndex(&font(), next_code_point(text));
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
    if (previous) x += scale * static_cast<float>(stbtt_GetGlyphKernAdvance(&font(), previous, glyph));
    place(glyph, x);
    x += scale * static_cast<float>(advance);
    previous = glyph;
  }
  return x;
}

// Blends a colour in linear light over the pixel, which may be transparent.
void blend(Image& image, int x, int y, const Rgb8& color, float coverage) {
  if (x < 0 || y < 0 || x >= image.width() || y >= image.height() || coverage <= 0) return;
  const auto& linear = linear_of_srgb8();
  std::uint8_t* pixel = image.at(x, y);
  const float below = image.channels() == 4 ? static_cast<float>(pixel[3]) / 255 : 1;
  const float alpha = coverage + below * (1 - coverage), fraction = coverage / alpha;
  for (int c = 0; c < 3; ++c)
    pixel[c] = srgb8_of_linear(linear[pixel[c]] + fraction * (linear[color[c]] - linear[pixel[c]]));
  if (image.channels() == 4) pixel[3] = static_cast<std::uint8_t>(255 * alpha + 0.5f);
}

void draw_glyph(Image& image, int glyph, float x, float y, float scale, const Rgb8& color) {
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const float shift_x = x - static_cast<float>(column), shift_y = y - static_cast<float>(row);
  int left, top, right, bottom;
  stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, shift_x, shift_y, &left, &top, &right,
                                  &bottom);
  const int width = right - left, height = bottom - top;
  if (width <= 0 || height <= 0) return;
  std::vector<unsigned char> coverage(static_cast<size_t>(width) * height);
  stbtt_MakeGlyphBitmapSubpixel(&font(), coverage.data(), width, height, width, scale, scale, shift_x,
                                shift_y, glyph);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      blend(image, column + left + i, row + top + j, color,
            static_cast<float>(coverage[j * width + i]) / 255);
}

}  // namespace

float text_width(std::string_view text, float size) {
  return for_each_glyph(text, font_scale(size), [](int, float) {});
}

void draw_text(Image& image, std::string_view text, float x, float y, const TextStyle& style) {
  const float scale = font_scale(style.size);
  for_each_glyph(text, scale,
                 [&](int glyph, float at) { draw_glyph(image, glyph, x + at, y, scale, style.color); });
}

void draw_rectangle(Image& image, float left, float top, float right, float bottom, const Rgb8& color) {
  const auto fraction = [](float low, float high, int pixel) {
    return std::clamp(std::min(high, pixel + 1.0f) - std::max(low, pixel * 1.0f), 0.0f, 1.0f);
  };
  for (int y = static_cast<int>(std::floor(top)); y < bottom; ++y)
    for (int x = static_cast<int>(std::floor(left)); x < right; ++x)
      blend(image, x, y, color, fraction(left, right, x) * fraction(top, bottom, y));
}

}  // namespace hysteron::render
