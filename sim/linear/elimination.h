// How a symmetric sparse matrix of 3x3 blocks is eliminated: the order of its nodes, and fronts of nodes that
// are eliminated together because they see the same later ones.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/linear/gathered_forces.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A symmetric sparse matrix of 3x3 blocks, assembled on the host: diagonal blocks and those below them.

// Pairs of nodes that a matrix couples, each once: row i lists the coupled j < i in ascending order.
using Couplings = Adjacency;

// Of nodes that belong together in sets, such as the vertices of a mesh's triangles.
class CouplingList {
 public:
  explicit CouplingList(int nodes) : below_(nodes) {}
  explicit CouplingList(const Adjacency& couplings);  // each in both directions, or in the lower row
  void add(std::span<const int> nodes);               // any two of them
  Couplings take();

 private:
  std::vector<std::vector<int>> below_;
};

class SymmetricBlocks {
 public:
  SymmetricBlocks() = default;
  explicit SymmetricBlocks(Couplings couplings);

  const Couplings& couplings() const { return couplings_; }
  int nodes() const { return static_cast<int>(diagonal.size()); }
  int slot(int i, int j) const;                    // of block (i, j), j < i, among those below; -1: none
  bool couples(std::span<const int> nodes) const;  // any two of them
  // Slots of any two of the nodes, in the order in which add() needs them.
  void find_slots(std::span<const int> nodes, std::vector<int>& slots) const;
  void set_zero();
  // Adds element e's B^T T B; every two of its vertices must be coupled.  Returns the slots after its own.
  const int* add(const ElementStiffness& stiffness, int e, const int* slots);
  // Rows and columns of held nodes become those of the identity.
  void hold(const char* held);

  std::vector<Eigen::Matrix3d> diagonal;
  std::vector<Eigen::Matrix3d> below;  // block (i, j) for each j that row i of the couplings lists

 private:
  Couplings couplings_;
  ElementStiffness::Rates rates_, forces_;  // scratch
};

// A dense part of the elimination.  Rows are nodes in the order of elimination; the first `pivots` of them
// are eliminated here, the others get an update that the parent front takes over.
struct Front {
  int first, pivots;           // numbers of its own nodes in the order of elimination
  int rows;                    // nodes, own ones first
  int row_start;               // of Elimination::row
  int place_start;             // of Elimination::place
  int block_start, block_end;  // of Elimination::block
  int parent;                  // the front that takes over its update; -1: it has none
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

// Fronts of so many columns each in this order, whose nodes need not see one another, without `stack` and
// `block`: children need not be right before their parents, and whoever fills the fronts knows the matrix.
Elimination plan_elimination(const Couplings& couplings, std::vector<int> order,
                             const std::vector<int>& columns);

// The couplings in both directions, each node's in ascending order.
Adjacency both_ways(const Couplings& below);

}  // namespace hysteron
