// Makes coarser and coarser sets of nodes on the rest shape, and the interpolation of fields between them.
#pragma once

#include <array>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A finer node's value is the weighted mean of three coarser nodes' values; the weights sum to 1.
struct Interpolation {
  std::array<int, 3> node;
  std::array<double, 3> weight;
};

struct RestLevel {
  int nodes = 0;
  std::vector<Interpolation> finer;  // one per node of the next finer level (for the first level, per vertex)
  Adjacency pattern;                 // off-diagonal blocks of a matrix on these nodes, columns ascending
  std::vector<double> plate_off_diagonal, plate_diagonal;  // one per item of `pattern`; one per node
};

// The levels from fine to coarse; empty for meshes too small to be worth it.  `plate` is the matrix of int
// (laplacian w)^2/2 over the rest shape for a scalar field w, computed from the hinges as in Bergou et al.
// 2006 (A Quadratic Bending Model for Inextensible Surfaces) for the interpolated fields.
using RestHierarchy = std::vector<RestLevel>;

// Makes the levels.  Fields are interpolated linearly over triangles of coarse nodes in the rest shape.  In
// the plate they vanish on `held` vertices (n flags).  `couplings` are the off-diagonal blocks of the
// vertices' matrix.
RestHierarchy make_rest_hierarchy(const ClothMesh& mesh, const Adjacency& couplings,
                                  const std::vector<char>& held);

}  // namespace hysteron
