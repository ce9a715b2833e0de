// How much smaller obstacles are drawn than they are.  Cloth touches a body with its vertices; the flat
// triangles between them cut below a round or an edged body, which would show through.
#pragma once

#include <Eigen/Core>
#include <span>

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

// The body smaller by an inset [m], as shaders draw it: along its axes if it is centred, else along its
// normals.
TriangleMesh shrunk(TriangleMesh mesh, float inset);

}  // namespace hysteron::render
