// Plans the elimination of a symmetric sparse matrix of 3x3 blocks: the order of its nodes, and fronts of
// nodes that are eliminated together because they are connected to the same later ones.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/linear/gathered_forces.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A symmetric sparse matrix of 3x3 blocks is assembled on the host: diagonal blocks and those below them.

// The pairs of nodes that a matrix couples, each once: row i lists the coupled j < i in ascending order.
using SparsityPattern = Adjacency;

// Collects couplings from sets of nodes, such as the vertices of a mesh's triangles.
class CouplingList {
 public:
  explicit CouplingList(int nodes) : below_(nodes) {}
  explicit CouplingList(const Adjacency& couplings);  // each in both directions, or in the lower row
  void add(std::span<const int> nodes);               // couples any two of them
  SparsityPattern take();

 private:
  std::vector<std::vector<int>> below_;
};

class SymmetricBlocks {
 public:
  SymmetricBlocks() = default;
  explicit SymmetricBlocks(SparsityPattern couplings);

  const SparsityPattern& couplings() const { return couplings_; }
  int nodes() const { return static_cast<int>(diagonal.size()); }
  int slot(int i, int j) const;                    // position of block (i, j), j < i, in `below`; -1: none
  bool couples(std::span<const int> nodes) const;  // are any two of them coupled?
  // Finds the positions for any two of the nodes, in the order in which add() needs them.
  void find_slots(std::span<const int> nodes, std::vector<int>& slots) const;
  void set_zero();
  // Adds element e's B^T T B; every two of its vertices must be coupled.  Returns the positions that follow
  // its own.
  const int* add(const ElementStiffness& stiffness, int e, const int* slots);
  // Makes rows and columns of held nodes (n flags) those of the identity.
  void hold(const char* held);

  std::vector<Eigen::Matrix3d> diagonal;
  std::vector<Eigen::Matrix3d> below;  // one for each (i, j) in the couplings

 private:
  SparsityPattern couplings_;
  ElementStiffness::Rates rates_, forces_;  // scratch
};

// A dense part of the elimination.  Its rows are nodes in the order of elimination; the first `pivots` of
// them are eliminated here, the others get an update that is added to the parent front.
struct Front {
  int first, pivots;           // its own nodes are first ... first + pivots - 1 in the order of elimination
  int rows;                    // number of nodes, own ones first
  int row_start;               // in SymbolicFactorization::row
  int parent_row_start;        // in SymbolicFactorization::parent_row
  int block_start, block_end;  // in SymbolicFactorization::block
  int parent;                  // the front that receives its update; -1: none
  int children;                // its children are this many of the last waiting fronts
  std::size_t panel;           // start of its 3 rows x 3 pivots numbers in the factor

  int updated() const { return rows - pivots; }
};

// The place where a block of the matrix enters a front.
struct EnteringBlock {
  int source;  // index in `below`; -1: the diagonal block of the column's node
  int row, column;
  bool transposed;
};

struct SymbolicFactorization {
  std::vector<int> order;  // the node that is eliminated k-th
  std::vector<Front> front;
  std::vector<int> row;         // for each front: the positions of its rows in the order
  std::vector<int> parent_row;  // for each front's updated rows: the row of the parent
  std::vector<EnteringBlock> block;
  std::size_t entries = 0;     // entries of the factor, including those above pivots
  std::size_t stack = 0;       // the most numbers of waiting updates
  double multiplications = 0;  // in one factorisation
};

// Orders nodes by approximate minimum degree (Amestoy, Davis & Duff 1996) and joins columns of the factor to
// fronts, even where that makes some zeros explicit (Ashcraft & Grimes 1989).
SymbolicFactorization plan_elimination(const SparsityPattern& couplings);

// Plans fronts of so many columns each in this order, whose nodes need not be connected, without `stack` and
// `block`: children need not be right before their parents, and the caller fills the fronts.
SymbolicFactorization plan_elimination(const SparsityPattern& couplings, std::vector<int> order,
                                       const std::vector<int>& columns);

// Returns the couplings in both directions, each node's in ascending order.
Adjacency both_ways(const SparsityPattern& below);

}  // namespace hysteron
