// Builds meshes of strips whose clamps hold whole columns of cells, for every mesh family.
#pragma once

#include <string>

#include "experiments/workbench/app/experiment.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

// A strip along x from 0 with a clamp at its near end, or one at either end.  A clamp holds two columns of
// vertices, the inner one on a straight line where the mesh of the family begins; cloth bends from the middle
// between them on, because the curvature at the inner one stands for half a cell on either side.
struct ClampedMesh {
  ClothMesh mesh;
  double spacing = 0;                              // distance of a clamp's columns [m]
  double length = 0;                               // length of the whole strip [m]
  double near() const { return spacing; }          // end of the near clamp along x [m]
  double far() const { return length - spacing; }  // beginning of the far clamp along x, if there is one [m]
};

// Builds the mesh with about `triangles` triangles on the bending cloth, whose `free_length` [m] is between
// the clamps' middles, or from the clamp's middle to the free end.  Throws Error::invalid_input for
// impossible meshes.
ClampedMesh clamped_mesh(const std::string& family, double free_length, double width, int triangles,
                         int clamps, unsigned seed);

// Returns the keys of scenes that do not affect such a mesh, and what fixes them.
std::vector<FixedKey> unused_by_clamped_meshes();
// Returns the same keys and those that are fixed if the cloth is always such a strip.
std::vector<FixedKey> decided_by_clamped_strips();

// Returns a pin that holds everything in between along x at rest, over the whole width [m].
Pin held_between(double from, double to);

// Builds a rectangle of the scene's family, scene.cloth.length long, whose clamp ends at the line x = `line`
// [m]: the clamp becomes the scene's only pin.  The mesh keeps one column of the clamped cells. Throws
// Error::invalid_input for impossible meshes.
Cloth clamp_at(Scene& scene, double line);

}  // namespace hysteron::experiments
