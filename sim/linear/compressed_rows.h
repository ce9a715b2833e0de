#pragma once

#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Rows of items, which it sorts, each item once.
Adjacency compressed(std::vector<std::vector<int>>& rows);

}  // namespace hysteron
