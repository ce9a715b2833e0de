// An inset in a corner of a picture draws moment against curvature so far: how a material came to where it
// is.
#pragma once

#include <vector>

#include "render/caption.h"
#include "render/image.h"

namespace hysteron::render {

// Pairs of curvature [1/m] and moment per width [N], in the order in which they were visited.
struct Path {
  std::vector<double> curvature, moment;
};

// The range of curvature [1/m] and moment per width [N] that an inset shows, zero included.
struct LoopFrame {
  double low_curvature = 0, high_curvature = 0, low_moment = 0, high_moment = 0;

  void include(const Path& path);
  // Returns a frame that holds most of these: on each axis it ignores ends farther from zero than three times
  // the median end of the side that reaches farther; paths are cut off there.
  static LoopFrame of_most(const std::vector<LoopFrame>& frames);
  bool empty() const { return low_curvature == high_curvature || low_moment == high_moment; }
};

struct LoopInset {
  Path path;               // path up to this instant; the last point carries a dot
  Path reference{};        // path in grey behind it; may be empty
  Rgb8 color{38, 40, 44};  // colour of the path
  LoopFrame frame{};       // common frame of compared insets; empty: that of both paths

  bool empty() const { return path.curvature.empty(); }
};

// Draws a straight line with round ends, blended in linear light [pixels].
void draw_line(Image& image, float x0, float y0, float x1, float y1, float width, const Rgb8& color);

// Returns true if an inset `side` wide [pixels] has room for the names of its axes.
bool names_loop_axes(float side, float letters);
// Draws an inset as a square of `fraction` of the picture's width, or twice that of its height where that is
// less, in that corner, with axes through zero; where it has room, each has a tick with its value and unit,
// whose capitals are `letters` pixels high.  Points that are not finite make gaps; parts outside the frame
// are not drawn. An empty path draws nothing.
void draw_loop(Image& image, const LoopInset& inset, Corner corner, float fraction, float letters);

}  // namespace hysteron::render
