#pragma once

#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Sorts the items of each row, makes each unique, and joins the rows.
Adjacency compressed(std::vector<std::vector<int>>& rows);
// Returns for each vertex those that share a triangle with it.
Adjacency neighbours_in(const ClothMesh& mesh);
// Returns the position of an item of such a row among all items.
int slot_in_row(const Adjacency& rows, int row, int item);

// The blocks of a symmetric matrix on and above its diagonal.

// One of these blocks, with the positions of itself and its transpose.
struct UpperBlock {
  int row, column;
  int slot, mirror;  // among the off-diagonal blocks; -1 on the diagonal
};

// Lists these blocks for a pattern of off-diagonal blocks, row by row, each row's diagonal first; columns
// ascend.
std::vector<UpperBlock> upper_blocks(const Adjacency& pattern);

}  // namespace hysteron
