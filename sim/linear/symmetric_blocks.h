// A symmetric sparse matrix of 3x3 blocks, assembled on the host: diagonal blocks and those below them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/linear/element_stiffness.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Pairs of nodes that a matrix couples, each once: row i lists the coupled j < i in ascending order.
using Couplings = Adjacency;

// Of nodes that belong together in sets, such as the vertices of a mesh's triangles.
class CouplingList {
 public:
  explicit CouplingList(int nodes) : below_(nodes) {}
  explicit CouplingList(const Couplings& couplings);
  void add(std::span<const int> nodes);  // any two of them
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

}  // namespace hysteron
