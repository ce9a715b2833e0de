// This header finds which vertices bending couples.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "sim/bending/curvature_operator.h"

namespace hysteron::test {

// Ordered pairs of vertices that share an edge or the hinges of one element; hinges are the first edges.
inline std::size_t coupled_pairs(const ClothMesh& mesh, const CurvatureOperator& op) {
  std::set<std::pair<int, int>> pairs;
  const auto couple = [&](const std::set<int>& vertices) {
    for (const int i : vertices)
      for (const int j : vertices)
        if (i != j) pairs.insert({i, j});
  };
  for (const Edge& e : mesh.edge) couple({e.p2, e.p3});
  for (int e = 0; e < op.elements(); ++e) {
    std::set<int> vertices;
    for (int j = op.hinge.start[e]; j < op.hinge.start[e + 1]; ++j) {
      const Edge& hinge = mesh.edge[op.hinge.item[j]];
      vertices.insert({hinge.p0, hinge.p1, hinge.p2, hinge.p3});
    }
    couple(vertices);
  }
  return pairs.size();
}

}  // namespace hysteron::test
