// Colour maps for scalar fields.
//
// Both maps are paths through Oklab (Ottosson 2020, "A perceptual color space for image processing"),
// computed here, not taken from a table.  Lightness is linear in the value (in its distance from the middle
// for the diverging one), so equal steps look equal and the order survives in grey; the hues run between blue
// and yellow or orange, which remain apart under red-green colour blindness.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

enum class ColorMap {
  sequential,  // dark blue - teal - pale yellow: amounts, 0 at the dark end
  diverging,   // blue - near white - orange brown: signed values, 0 in the middle
};

// Returns linear-light red, green, blue at t in [0, 1] (clamped), always inside the sRGB gamut.
Eigen::Vector3f map_color(ColorMap map, float t);

// Returns the same colour sRGB-encoded.
Rgb8 map_color8(ColorMap map, float t);

// Colours of series and methods that colour-blind eyes can tell apart (Okabe & Ito 2008); they repeat after
// the last.
inline constexpr int kMethodColors = 7;
Rgb8 method_color(std::size_t index);

// Returns a shade for one of `members` methods of one kind: `family` sets the hue (blue, orange, green or
// purple), and `member` runs from dark to light with a turn of the hue.  No two are the same for fewer than 5
// families.
Rgb8 family_color(int family, int member, int members);

std::string hex(const Rgb8& color);  // "#RRGGBB"

}  // namespace hysteron::render
