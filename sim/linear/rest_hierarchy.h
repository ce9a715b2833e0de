// Coarser and coarser vertex sets on the rest shape, and how fields on them are interpolated.
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
  std::vector<Interpolation> finer;  // for each node of the next finer level (the vertices, for the first)
  Adjacency pattern;                 // off-diagonal blocks of a matrix on these nodes, columns ascending
  std::vector<double> plate_off_diagonal, plate_diagonal;  // the former: an entry for each of the pattern's
};

// From fine to coarse; empty for meshes too small to be worth it.  `plate` is the matrix of int (laplacian
// w)^2/2 over the rest shape for a scalar field w: from the hinges as in Bergou et al. 2006 (A Quadratic
// Bending Model for Inextensible Surfaces), as the interpolated fields have it.
using RestHierarchy = std::vector<RestLevel>;

// Fields are interpolated linearly over triangles of coarse nodes in the rest shape.  They vanish on `held`
// vertices, where plate counts that.  `couplings`: off-diagonal blocks of the vertices' matrix.
RestHierarchy make_rest_hierarchy(const ClothMesh& mesh, const Adjacency& couplings,
                                  const std::vector<char>& held);

}  // namespace hysteron
