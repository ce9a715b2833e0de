// Moment against curvature so far, drawn small into a corner of a picture: which way a material came to where
// it is.
#pragma once

#include <vector>

#include "render/caption.h"
#include "render/image.h"

namespace hysteron::render {

// Pairs of curvature [1/m] and moment per width [N], in the order in which they were visited.
struct Path {
  std::vector<double> curvature, moment;
};

// What an inset shows, zero within.
struct LoopFrame {
  double low_curvature = 0, high_curvature = 0, low_moment = 0, high_moment = 0;

  void include(const Path& path);
  // As far as any of these reaches that does not reach three times as far along the axis as the middle one of
  // them, to either side; what goes beyond is cut off.
  static LoopFrame of_most(const std::vector<LoopFrame>& frames);
  bool empty() const { return low_curvature == high_curvature || low_moment == high_moment; }
};

struct LoopInset {
  Path path;               // up to this instant; the last point carries a dot
  Path reference{};        // in grey behind it; may be empty
  Rgb8 color{38, 40, 44};  // of the path
  LoopFrame frame{};       // of insets that are compared; an empty one: that of both paths

  bool empty() const { return path.curvature.empty(); }
};

// A straight line with round ends, blended in linear light.
void draw_line(Image& image, float x0, float y0, float x1, float y1, float width, const Rgb8& color);

// Whether an inset so wide [pixels] has room for what stands at its axes.
bool names_loop_axes(float side, float letters);
// A square of `fraction` of the picture's width, or twice that of its height where that is less, in that
// corner, with axes through zero; where it has room, each has a tick with its value and unit, whose capitals
// are `letters` pixels high.  Points that are not finite make gaps; what is outside of the frame is not
// drawn. An empty path draws nothing.
void draw_loop(Image& image, const LoopInset& inset, Corner corner, float fraction, float letters);

}  // namespace hysteron::render
