// Meshes of strips whose clamps hold whole columns of cells, for every mesh family.
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
  double spacing = 0;                              // of a clamp's columns [m]
  double length = 0;                               // of the whole strip [m]
  double near() const { return spacing; }          // the near clamp holds x up to here [m]
  double far() const { return length - spacing; }  // the far clamp, if there is one, x from here on [m]
};

// `free_length` is that of the cloth that bends: between the clamps' middles, or from the clamp's middle to
// the free end [m].  About `triangles` triangles on it.  Error::invalid_input for impossible meshes.
ClampedMesh clamped_mesh(const std::string& family, double free_length, double width, int triangles,
                         int clamps, unsigned seed);

// Keys of scenes that say nothing of such a mesh, and what then holds it.
std::vector<DecidedKey> unused_by_clamped_meshes();
// The same, and what is decided where the cloth is always such a strip.
std::vector<DecidedKey> decided_by_clamped_strips();

// Holds what lies in between along x at rest, over the whole width [m].
Pin held_between(double from, double to);

// A rectangle of the scene's family, scene.cloth.length long, whose clamp ends at the line x = `line` [m]:
// the clamp becomes the scene's only pin.  The mesh keeps one column of cells of what is clamped.
// Error::invalid_input for impossible meshes.
Cloth clamp_at(Scene& scene, double line);

}  // namespace hysteron::experiments
