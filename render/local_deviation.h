// How much relief is seen in a picture of cloth.
#pragma once

#include <vector>

#include "render/image.h"

namespace hysteron::render {

struct LocalDeviation {
  double median = 0;  // [L*]; NaN of no pixel
  long pixels = 0;    // that it is the median of
};

// Standard deviation of the lightness L* (CIE 15:2004) in a square of `side` pixels, an odd number, around
// each pixel of `part` whose square lies wholly in `cloth`: their median.  Both masks have one truth a pixel,
// rows from the top.  Of a sine that is finer than the square and of amplitude a: a/sqrt 2.
LocalDeviation local_deviation(const Image& image, const std::vector<char>& cloth,
                               const std::vector<char>& part, int side = 21);

}  // namespace hysteron::render
