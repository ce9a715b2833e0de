// How much smaller obstacles are drawn than they are.  Cloth touches a body with its vertices; the flat
// triangles between them cut below a round or an edged body, which would show through.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "render/caption.h"
#include "render/image.h"
#include "render/shapes.h"

namespace hysteron::render {

// What an inset depends on [m].
struct BodyMeasure {
  explicit BodyMeasure(const TriangleMesh& mesh);

  Eigen::Vector3f half_extent;  // of the mesh's box
  float roundness;              // as the mesh's
  bool centred;                 // as the mesh's
};

// The side that nine in ten triangles' longest ones do not exceed [m]; `dimension` coordinates a vertex.
// Seams of a pattern, whose triangles span it, are fewer.  0 without triangles.
float long_side(std::span<const int> triangles, std::span<const float> coordinates, int dimension);

// Depth below a body to which a triangle of this side reaches, its corners on the body [m]: the sagitta
// side^2 / (6 R) of an equilateral triangle's circle on a radius R, but at an edge no more than what a turn
// by 60 degrees within one side needs of a body that is smaller by as much on all sides.
float cut_depth(float side, float roundness);

// Inset for cloth of this side [m]: cut_depth(), at least `least`, but no more than a share of the body's
// thickness that leaves thin plates to be seen.
float body_inset(const BodyMeasure& body, float side, float least);

// Moment against curvature so far, drawn small into a corner of a picture: which way a material came to where
// it is.

// Pairs of curvature [1/m] and moment per width [N], in the order in which they were visited.
struct Path {
  std::vector<double> curvature, moment;
};

// What an inset shows, zero within.
struct LoopFrame {
  double low_curvature = 0, high_curvature = 0, low_moment = 0, high_moment = 0;

  void include(const Path& path);
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

// A square of `share` of the picture's width, or twice that of its height where that is less, in that corner,
// with axes through zero named M and κ, whose capitals are `letters` pixels high.  Points that are not finite
// make gaps.  An empty path draws nothing.
void draw_loop(Image& image, const LoopInset& inset, Corner corner, float share, float letters);

}  // namespace hysteron::render
