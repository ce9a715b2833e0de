// How a symmetric sparse matrix of 3x3 blocks is eliminated: the order of its nodes, and fronts of nodes that
// are eliminated together because they see the same later ones.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/linear/symmetric_blocks.h"

namespace hysteron {

// A dense part of the elimination.  Rows are nodes in the order of elimination; the first `pivots` of them
// are eliminated here, the others get an update that the parent front takes over.
struct Front {
  int first, pivots;           // numbers of its own nodes in the order of elimination
  int rows;                    // nodes, own ones first
  int row_start;               // of Elimination::row
  int place_start;             // of Elimination::place
  int block_start, block_end;  // of Elimination::block
  int children;                // the fronts before it, as long as they are nobody else's
  std::size_t panel;           // where its 3 rows x 3 pivots numbers start in the factor

  int updated() const { return rows - pivots; }
};

// Where a block of the matrix enters a front.
struct EnteringBlock {
  int source;  // among the blocks below the diagonal; -1: the diagonal block of the column's node
  int row, column;
  bool transposed;
};

struct Elimination {
  std::vector<int> order;  // node that is eliminated k-th
  std::vector<Front> front;
  std::vector<int> row;    // of each front: when its rows are eliminated
  std::vector<int> place;  // of each front's updated rows: the row of the parent that each is
  std::vector<EnteringBlock> block;
  std::size_t entries = 0;     // of the factor, those above pivots included
  std::size_t stack = 0;       // most numbers of updates that wait at once
  double multiplications = 0;  // of one factorisation
};

// Orders nodes by approximate minimum degree (Amestoy, Davis & Duff 1996) and joins columns of the factor to
// fronts, also where that makes some zeros explicit (Ashcraft & Grimes 1989).
Elimination plan_elimination(const Couplings& couplings);

}  // namespace hysteron
