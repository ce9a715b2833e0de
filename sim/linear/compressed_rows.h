#pragma once

#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Rows of items, which it sorts, each item once.
Adjacency compressed(std::vector<std::vector<int>>& rows);
// Vertices that share a triangle, row by row.
Adjacency neighbours_in(const ClothMesh& mesh);
// Where an item of such a row stands among all items.
int slot_in_row(const Adjacency& rows, int row, int item);

// The blocks of a symmetric matrix on and above its diagonal.

// One of them, and where it and its transpose stand.
struct UpperBlock {
  int row, column;
  int slot, mirror;  // among the off-diagonal blocks; -1 on the diagonal
};

// Of a pattern of off-diagonal blocks, row by row, each row's diagonal first; columns ascend.
std::vector<UpperBlock> upper_blocks(const Adjacency& pattern);

}  // namespace hysteron
