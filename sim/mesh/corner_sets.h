// Corners of triangles, numbered 3*face + corner, and sets of numbers.
#pragma once

#include <numeric>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Sets of the numbers 0 ... n-1, which are joined one pair at a time.
class Sets {
 public:
  explicit Sets(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[root(i)] = root(j); }

 private:
  std::vector<int> parent_;
};

// Returns 3*face + corner, where that face has the vertex.
inline int corner_at(const ClothMesh& mesh, int face, int vertex) {
  const Eigen::Vector3i& f = mesh.face[face];
  return 3 * face + (f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2);
}

}  // namespace hysteron
