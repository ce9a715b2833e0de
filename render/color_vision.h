// Differences of two colours for eyes with and without colour deficiencies.
#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

// Returns the CIEDE2000 difference of two sRGB colours (Sharma, Wu & Dalal 2005, "The CIEDE2000
// color-difference formula").
double color_difference(const Rgb8& a, const Rgb8& b);
// Returns the least color_difference() for the eye without a deficiency and for protanopia, deuteranopia and
// tritanopia (Machado, Oliveira & Fernandes 2009, severity 1).
double least_color_difference(const Rgb8& a, const Rgb8& b);

// Returns a pattern for each colour ("#RRGGBB") of lines or dots in one picture, 0 for the plain one, that
// differs from those of all earlier colours within a least_color_difference() of 12.
std::vector<int> patterns_beside(const std::vector<std::string>& colors);

}  // namespace hysteron::render
