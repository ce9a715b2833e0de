// Measures of the difference between two pictures.
#pragma once

#include "render/image.h"

namespace hysteron::render {

// Differences over all pixels and the channels red, green, blue, in 8-bit steps (0 to 255) of the encoded
// values.
struct Difference {
  double mean_abs = 0;               // mean absolute difference
  double rmse = 0;                   // root of the mean squared difference
  double psnr_db = 0;                // 20 log10(255 / rmse), infinite for equal pictures
  double pixels_over_8_percent = 0;  // share of pixels with a channel that differs by more than 8 [%]
};

// Error::invalid_input unless both pictures have the same size and a pixel.
void require_same_size(const Image& a, const Image& b);

// Error::invalid_input if the sizes differ.  Alpha is ignored.
Difference compare(const Image& a, const Image& b);

// Draws the largest channel difference of every pixel: dark for equal, up to pale yellow from `full_scale`
// on.
Image heat_map(const Image& a, const Image& b, int full_scale = 64);

}  // namespace hysteron::render
