// How far apart two colours are for whoever looks at them.
#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

// CIEDE2000 of two sRGB colours (Sharma, Wu & Dalal 2005, "The CIEDE2000 color-difference formula").
double color_difference(const Rgb8& a, const Rgb8& b);
// The least of it for the eye without a deficiency and for one without either of its three kinds of cones:
// protanopia, deuteranopia, tritanopia (Machado, Oliveira & Fernandes 2009, severity 1).
double least_color_difference(const Rgb8& a, const Rgb8& b);

// Of colours that are drawn as lines or dots in one picture, "#RRGGBB" each: the number of the pattern, 0 for
// the plain one, that tells each from all before it of less than 12 of least_color_difference().
std::vector<int> patterns_beside(const std::vector<std::string>& colors);

}  // namespace hysteron::render
