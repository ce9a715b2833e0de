// Nested dissection (George 1973) for devices on which a level of fronts costs waiting and its fronts run at
// once at almost no cost: it makes few levels of large fronts.  METIS, whose separators are shorter in
// sheets, draws from the C library's random numbers, which the whole program shares: runs would not be
// repeatable.
#pragma once

#include "sim/linear/elimination.h"

namespace hysteron {

struct Dissection {
  std::vector<int> order;    // the node that is eliminated k-th
  std::vector<int> columns;  // number of columns of each front, in that order
};

// `depth` is how often nodes are divided; the separators of the first `joined` divisions form one front.
struct DissectionShape {
  int depth = 0, joined = 0;
};

// Divides by the narrowest separators that level structures near the middle have (George & Liu 1978).  The
// joined separators form the last front; every other separator is a front of its own, and so is each
// remaining part.
Dissection dissect(const Adjacency& graph, const DissectionShape& shape);

// A front in whole tiles has three numbers a node, own ones first, then the rows that get an update, both
// filled up with rows of zeros.
struct TiledFront {
  int level;               // in the tree of fronts; leaves: 0
  int pivot_tiles, tiles;  // rows of tiles that are eliminated, and all
  std::size_t number = 0;  // start of its stride x stride numbers, row-major
  int source = 0;          // start of its `stride` columns in a list of all fronts' columns
  int stride() const;
  int pivot_rows() const;  // rows of zeros included
};

// The rough cost on an NVIDIA H100 [us]: few levels and few tiles in sequence are fast.
struct TiledCost {
  double renewal = 0;      // cost of a factorisation
  double application = 0;  // cost of an application to a vector
};

struct TiledPlan {
  SymbolicFactorization elimination;
  std::vector<TiledFront> front;        // in the order of elimination.front
  std::vector<std::vector<int>> level;  // the fronts of each level, whose numbers are contiguous
  std::size_t numbers = 0;              // how many numbers all fronts have
  int sources = 0;
  TiledCost cost;
};

inline constexpr int kTile = 32;  // rows of a tile, which a block of GPU threads handles
inline constexpr int kMaxFrontLevels = 4;

TiledPlan plan_dissection(const SparsityPattern& couplings, const DissectionShape& shape);
// Returns the shape of the lowest estimated cost.
DissectionShape choose_shape(const SparsityPattern& couplings);

inline int TiledFront::stride() const { return tiles * kTile; }
inline int TiledFront::pivot_rows() const { return pivot_tiles * kTile; }

}  // namespace hysteron
