// Tables of all positions in the fronts of a plan: blocks of the matrix, updates of children, rows of solves.
#pragma once

#include <vector>

#include "sim/linear/front_rows.h"

namespace hysteron {

// The position at which a block of the matrix enters; its row is eliminated after its column, or in the same
// block.
struct FrontBlock {
  int slot;            // index among the off-diagonal blocks; -1: a diagonal one
  int row, column;     // vertices
  std::size_t number;  // start of its numbers
  int stride;
};

// A front as its level's loops use it.
struct FrontOfLevel {
  std::size_t number;
  int stride, pivot_rows;
  int source;
  int first_child, end_child;
};

// An update from a child: for each of the front's rows the child's row, -1 where it has none.
struct FrontChild {
  std::size_t number;
  int stride;
  int row_start;
};

struct FrontTables {
  std::vector<int> source;  // the unknown of each front's columns; -1: a column of zeros
  std::vector<FrontTerm> term;
  std::vector<std::vector<RowAbove>> above;      // one list per level
  std::vector<std::vector<SolvedRow>> solved;    // one list per level
  std::vector<std::vector<FrontOfLevel>> front;  // one list per level
  std::vector<FrontChild> child;
  std::vector<int> child_row;
  std::vector<FrontBlock> block;  // blocks of the matrix's lower triangle
  std::vector<std::size_t> ones;  // diagonal numbers that fill up tiles
};

// A front for look-ups.
struct FrontRange {
  int first, pivots, rows;  // nodes: when its first is eliminated, its own, all
  int row_start;            // in Elimination::row
  std::size_t number;
  int stride, pivot_rows;
};

// Finds where blocks enter, on either device.
struct FrontFinder {
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  const int *rank, *owner;  // of each vertex: its position in the elimination, its front
  const FrontRange* front;
  const int* row;  // Elimination::row

  // Returns the block of two vertices without its `slot`; its number is kNowhere if no front has both.
  HYST_HD FrontBlock find(int i, int j) const {
    const int later = rank[i] < rank[j] ? j : i, sooner = later == i ? j : i;
    const FrontRange range = front[owner[sooner]];
    FrontBlock block{-1, later, sooner, kNowhere, range.stride};
    int low = 0, high = range.rows;  // the first row that is not eliminated before
    while (low < high) {
      const int middle = (low + high) / 2;
      if (row[range.row_start + middle] < rank[later])
        low = middle + 1;
      else
        high = middle;
    }
    if (low == range.rows || row[range.row_start + low] != rank[later]) return block;
    const std::size_t at = low < range.pivots ? 3 * low : range.pivot_rows + 3 * (low - range.pivots);
    block.number = range.number + at * range.stride + 3 * (rank[sooner] - range.first);
    return block;
  }
  HYST_HD bool couples(const int* vertex, int count) const {  // are any two coupled?
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < a; ++b)
        if (find(vertex[a], vertex[b]).number == kNowhere) return false;
    return true;
  }
};

struct FrontPlaces {
  std::vector<int> rank, owner;
  std::vector<FrontRange> front;
  std::vector<int> row;

  explicit FrontPlaces(const TiledPlan& plan);
  FrontFinder finder() const { return {rank.data(), owner.data(), front.data(), row.data()}; }
};

// Makes the tables for matrices of this pattern of off-diagonal blocks, all of whose couplings the plan has.
FrontTables make_front_tables(const TiledPlan& plan, const Adjacency& pattern);

}  // namespace hysteron
