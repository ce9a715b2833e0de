// Structural similarity of two pictures.
#pragma once

#include "render/image.h"

namespace hysteron::render {

// Mean SSIM index (Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to
// Structural Similarity", Eq. 13, 17) of the luma Y' = 0.299 R' + 0.587 G' + 0.114 B' of the encoded 8-bit
// values, not rounded: 1 for equal pictures, less for others, at least -1.  Windows of 11 x 11 pixels under a
// Gaussian of sigma 1.5 pixels, K1 = 0.01, K2 = 0.03, L = 255; no reduction of the size beforehand.
//
// Borders: only windows that lie inside the picture count, as in the authors' program; where a side has fewer
// than 11 pixels, the window has the largest odd number of pixels that fits.
// Error::request if the sizes differ.  Alpha is ignored.
double ssim(const Image& a, const Image& b);

}  // namespace hysteron::render
