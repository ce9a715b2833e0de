// Where everything stands in the fronts of a plan: blocks of the matrix, updates of children, rows of solves.
#pragma once

#include <vector>

#include "sim/linear/front_rows.h"

namespace hysteron {

// Where a block of the matrix enters; its row is eliminated after its column, or in the same block.
struct FrontBlock {
  int slot;            // among the matrix's off-diagonal blocks; -1: a diagonal one
  int row, column;     // vertices
  std::size_t number;  // where its first number goes
  int stride;
};

// A front as its level's loops see it.
struct FrontOfLevel {
  std::size_t number;
  int stride, pivot_rows;
  int source;
  int first_child, end_child;
};

// What a front takes over from a child: for each of the front's rows the child's, -1 where it has none.
struct FrontChild {
  std::size_t number;
  int stride;
  int row_start;
};

struct FrontTables {
  std::vector<int> source;  // of each front's columns the unknowns; -1: a column of zeros
  std::vector<FrontTerm> term;
  std::vector<std::vector<RowAbove>> above;      // of each level
  std::vector<std::vector<SolvedRow>> solved;    // of each level
  std::vector<std::vector<FrontOfLevel>> front;  // of each level
  std::vector<FrontChild> child;
  std::vector<int> child_row;
  std::vector<FrontBlock> block;  // of the matrix's lower triangle
  std::vector<std::size_t> ones;  // diagonal numbers that fill up tiles
};

class FrontPlaces {
 public:
  explicit FrontPlaces(const TiledPlan& plan);

  // Where the block of two vertices enters, `slot` left open; a number of kNowhere: no front has both.
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  FrontBlock find(int i, int j) const;
  bool couples(std::span<const int> vertices) const;  // any two of them

 private:
  const TiledPlan& plan_;
  std::vector<int> rank_, owner_;  // of each vertex: when it is eliminated, in which front
};

// For matrices of this pattern of off-diagonal blocks, all of whose couplings the plan has.
FrontTables make_front_tables(const TiledPlan& plan, const Adjacency& pattern);

}  // namespace hysteron
