// Nested dissection (George 1973) for devices on which a level of fronts costs waiting and what its fronts do
// at once costs next to nothing: few levels of large fronts.  METIS, whose separators are shorter in sheets,
// draws from the C library's random numbers, which are those of the whole program: runs would not be
// repeated.
#pragma once

#include "sim/linear/elimination.h"

namespace hysteron {

struct Dissection {
  std::vector<int> order;    // node that is eliminated k-th
  std::vector<int> columns;  // of each front, in that order
};

// How often nodes are divided; the separators of the first `joined` divisions are one front.
struct DissectionShape {
  int depth = 0, joined = 0;
};

// Divides by the narrowest separators that level structures near the middle have (George & Liu 1978).  The
// front of joined separators is the last; every other separator is a front of its own, and so is each part
// that is left.
Dissection dissect(const Adjacency& graph, const DissectionShape& shape);

// A front in whole tiles: three numbers a node, own ones first, then the rows that get an update, both filled
// up with rows of zeros.
struct TiledFront {
  int level;               // of the tree of fronts; leaves: 0
  int pivot_tiles, tiles;  // rows of tiles that are eliminated, and all
  std::size_t number = 0;  // where its stride x stride numbers start, row by row
  int source = 0;          // where its `stride` columns start in a list of all fronts' columns
  int stride() const;
  int pivot_rows() const;  // those of zeros, too
};

// What an NVIDIA H100 takes for it, roughly [us]: few levels and few tiles in sequence are fast.
struct TiledCost {
  double renewal = 0;      // a factorisation
  double application = 0;  // to a vector
};

struct TiledPlan {
  Elimination elimination;
  std::vector<TiledFront> front;        // as elimination.front
  std::vector<std::vector<int>> level;  // fronts of each, whose numbers stand one after the other
  std::size_t numbers = 0;              // of all fronts
  int sources = 0;
  TiledCost cost;
};

inline constexpr int kTile = 32;  // rows of a tile, which a block of a GPU's threads takes
inline constexpr int kMaxFrontLevels = 4;

TiledPlan plan_dissection(const Couplings& couplings, const DissectionShape& shape);
// The shape that costs least by the above.
DissectionShape choose_shape(const Couplings& couplings);

inline int TiledFront::stride() const { return tiles * kTile; }
inline int TiledFront::pivot_rows() const { return pivot_tiles * kTile; }

}  // namespace hysteron
