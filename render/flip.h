// FLIP measures how visible the difference of two pictures is that are shown in turn at one place.
#pragma once

#include <array>
#include <numbers>

#include "render/image.h"
#include "render/plane.h"

namespace hysteron::render {

// Pixels per degree of a monitor 0.7 m wide with 3840 pixels, seen from 0.7 m: the setting of Andersson et
// al. 2020.
inline constexpr double kPixelsPerDegree = 3840 * std::numbers::pi / 180;

// Returns the LDR-FLIP of every pixel, 0 (equal) to 1, whichever picture comes first (Andersson, Nilsson,
// Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images",
// HPG; symbols as there).  The colours that an eye can tell apart at that distance are compared by HyAB in
// L*a*b* with the Hunt effect, and the difference is raised where edges or points stand in one picture only.
// Filters repeat the border's pixels beyond it. Error::invalid_input if the sizes differ or pixels_per_degree
// is not in [1, 1000].  Alpha is ignored.
Plane flip_map(const Image& a, const Image& b, double pixels_per_degree = kPixelsPerDegree);

// One picture as FLIP sees it, for pictures that are compared with several.
struct SeenPicture {
  std::array<Plane, 3> color;  // Hunt-adjusted L*, a*, b*
  Plane edges, points;         // strength of edges and of points
};
SeenPicture seen_picture(const Image& image, double pixels_per_degree = kPixelsPerDegree);
Plane flip_map(const SeenPicture& a, const SeenPicture& b);

// Returns the mean FLIP, by which whole pictures are compared.
inline double flip(const Image& a, const Image& b, double pixels_per_degree = kPixelsPerDegree) {
  return mean(flip_map(a, b, pixels_per_degree));
}
inline double flip(const SeenPicture& a, const SeenPicture& b) { return mean(flip_map(a, b)); }

// Draws errors as colours: dark for 0, up to pale yellow for 1.
Image heat_map(const Plane& errors);

}  // namespace hysteron::render
