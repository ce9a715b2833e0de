// Pictures of few colours: a third of the bytes of the same picture in RGB, for pages that hold many.
#pragma once

#include <cstdint>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

// 8 bits a pixel, rows from the top, no padding.
struct PaletteImage {
  int width = 0, height = 0;
  std::vector<Rgb8> colors;         // at most 256
  std::vector<std::uint8_t> index;  // of each pixel's colour
};

// The same picture in at most `count` colours, alpha dropped: the colours are cut into boxes as by Heckbert
// (1982, Color image quantization for frame buffer display), but always the box with the largest squared
// error, across the channel that varies most, at that channel's mean; a box is drawn in its mean colour. Sums
// are of integers: the same pixels give the same palette.  A picture of no more colours is kept as it is.
// Error::request if the picture is empty or `count` is not in [1, 256].
PaletteImage in_few_colors(const Image& image, int count);

// PNG file in memory.  Error::request if the picture is empty.
std::vector<std::uint8_t> encode_png(const PaletteImage& image);

}  // namespace hysteron::render
