// Finds triangles of a surface that pass through each other, by exact predicates: an independent check of
// contact.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Returns pairs of triangles (first < second) that intersect at these positions [m], in ascending order;
// triangles that share an edge count as neighbours and never do, those that share a vertex only where they
// meet elsewhere as well.  The search ends at a million pairs.
std::vector<std::pair<int, int>> intersecting_triangles(const std::vector<Eigen::Vector3i>& face,
                                                        const std::vector<Eigen::Vector3d>& position);

// Does the same for two surfaces that share no vertex: pairs of a triangle of the first and one of the
// second.
struct TriangleSet {
  const std::vector<Eigen::Vector3i>& face;
  const std::vector<Eigen::Vector3d>& position;  // [m]
};
std::vector<std::pair<int, int>> crossing_triangles(const TriangleSet& first, const TriangleSet& second);

// Names the first three pairs for messages: "12 and 97, 12 and 98, ... (31 pairs in all)".
std::string pairs_text(const std::vector<std::pair<int, int>>& pairs);

}  // namespace hysteron
