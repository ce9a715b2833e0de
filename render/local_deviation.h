// A measure of the relief seen in a picture of cloth.
#pragma once

#include <vector>

#include "render/image.h"

namespace hysteron::render {

struct LocalDeviation {
  double median = 0;  // median deviation [L*]; NaN without pixels
  long pixels = 0;    // number of pixels with a deviation
};

// Returns the median, over the pixels of `part`, of the standard deviation of the lightness L* (CIE 15:2004)
// in a square of `side` pixels (an odd number) around each; squares must lie wholly in `cloth`.  Both masks
// have one truth value per pixel, rows from the top.  A sine finer than the square and of amplitude a gives
// a/sqrt 2.
LocalDeviation local_deviation(const Image& image, const std::vector<char>& cloth,
                               const std::vector<char>& part, int side = 21);

}  // namespace hysteron::render
