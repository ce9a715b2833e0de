// Nodes at which a stiff membrane averages its strains along warp and weft.
//
// Triangles of constant strain are flat: where mesh edges do not lie along a fold, threads of such triangles
// must be stretched for the cloth to bend, and coarse cloth of stiff threads hardly bends (membrane locking).
// Here a triangle keeps up to 1 kN/m of the stiffness along warp and weft, and all of the shear, and the rest
// acts on the means of strains over the triangles around a node (averaged nodal strain, Bonet & Burton 1998;
// Dohrmann et al. 2000):
//
//   mean_v = sum_f A_f/(3 A_v) (E11, E22)_f,  A_v = sum_f A_f/3
//   W = sum_f A_f W_c(E_f) + sum_v A_v W_(C - c)(mean_v)
//   stress of a triangle = c E_f + 1/3 sum over its nodes of (C - c) mean_v
//
// Means alone would leave triangles free to stretch against one another; what they keep holds them.
#pragma once

#include "sim/membrane/green_lagrange.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline constexpr double kMaxTriangleStiffness = 1000;  // what they keep along warp and weft, at most [N/m]

// Stiffness that acts on strains of triangles, and on means at nodes (no shear).
struct MembraneSplit {
  MembraneStiffness<double> faces, nodes;
  bool averages = false;  // there are nodes
};

// Nothing is averaged where `element` is constant and where warp and weft have at most 1 kN/m, their stops
// included. Both parts are positive semidefinite.
MembraneSplit split_membrane(const Fabric& fabric, MembraneElement element);

// Stops whose strains are those of triangles, and of nodes.
InPlaneStops stops_of_faces(const Fabric& fabric, const MembraneSplit& split);
InPlaneStops stops_of_nodes(const Fabric& fabric, const MembraneSplit& split);

// A vertex is a node, or several where panels are sewn or touch: each has the triangles that go on into one
// another.
struct MembraneNodes {
  std::vector<double> area;              // A_v [m^2]
  std::vector<Eigen::Vector3i> of_face;  // the node at each corner
  Adjacency faces;                       // of each node 3*face + corner there
  Adjacency ring;                        // of each node the vertices of its triangles, ascending
  Adjacency corners;  // of each item of `ring` 3*face + corner where it is in these triangles

  int count() const { return static_cast<int>(area.size()); }
};
MembraneNodes membrane_nodes(const ClothMesh& mesh);

// Off-diagonal blocks of the membrane's matrix: vertices that share a triangle, and with nodes a ring.
Adjacency membrane_couplings(const ClothMesh& mesh, const Fabric& fabric, MembraneElement element);

}  // namespace hysteron
