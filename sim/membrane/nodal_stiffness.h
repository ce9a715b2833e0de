// Adds the part of nodes (membrane_nodes.h) to the membrane's matrix: A_v B^T (C - c) B with B the derivative
// of a node's mean strains by the vertices of its ring.
#pragma once

#include "sim/linear/block_rows.h"
#include "sim/membrane/membrane_nodes.h"
#include "sim/membrane/membrane_sites.h"

namespace hysteron {

// The rates of a node's mean strains along warp and weft by a vertex's position [1/m].
template <class Real>
struct NodeRates {
  Vec3<Real> warp, weft;
};

template <class Real, class Device>
class NodalStiffness {
 public:
  NodalStiffness(Device& device, const MembraneNodes& nodes, const BlockRows<Real, Device>& rows);

  // Adds factor * elastic stiffness + of_stops * the stops' tangents along warp and weft to the matrix, where
  // the triangles were evaluated last.
  void add(const MembraneSites<NodeStrains<Real>, Device>& nodes, Real factor, Real of_stops,
           BlockRowsView<Real> matrix);
  std::size_t bytes() const { return total_bytes(node_, corner_start_, corner_, rate_, pair_start_, pair_); }

  // The parts of add(); public because nvcc allows no device lambda in a private member function.
  void find_rates(const NodeStrains<Real>& strains);

 private:
  Device& device_;
  Buffer<int, Device> node_, corner_start_, corner_;  // for each item of the rings
  Buffer<NodeRates<Real>, Device> rate_;
  // For each block, off-diagonal ones first, the pairs of items that add to it.
  Buffer<int, Device> pair_start_;
  Buffer<Eigen::Vector2i, Device> pair_;
};

}  // namespace hysteron
