// Obstacles are drawn smaller by an inset: cloth touches a body with its vertices, and the flat triangles
// between them cut below a round or an edged body, which would show through.
#pragma once

#include <Eigen/Core>
#include <span>

#include "render/shapes.h"

namespace hysteron::render {

// The measures of a body that its inset depends on [m].
struct BodyMeasure {
  explicit BodyMeasure(const TriangleMesh& mesh);

  Eigen::Vector3f half_extent;  // half the edges of the mesh's box
  float roundness;              // least radius, TriangleMesh::roundness
  bool centred;                 // TriangleMesh::centred
};

// Returns the side that nine in ten triangles' longest ones do not exceed [m], 0 without triangles;
// `dimension` is the number of coordinates per vertex.  The few triangles that span a pattern's seams do not
// raise it.
float long_side(std::span<const int> triangles, std::span<const float> coordinates, int dimension);

// Returns how deep a triangle of this side reaches below a body on which its corners lie [m]: the sagitta
// side^2 / (6 R) of an equilateral triangle's circle on a radius R, but at an edge no more than what a turn
// by 60 degrees within one side needs of a body that is smaller by as much on all sides.
float cut_depth(float side, float roundness);

// Returns the inset for cloth of this side [m]: cut_depth(), at least `least`, but no more than a share of
// the body's thickness that leaves thin plates to be seen.
float body_inset(const BodyMeasure& body, float side, float least);

// Makes a body smaller by an inset [m], as shaders draw it: along its axes if it is centred, else along its
// normals.
TriangleMesh shrunk(TriangleMesh mesh, float inset);

}  // namespace hysteron::render
