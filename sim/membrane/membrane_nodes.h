// Defines nodes at which a stiff membrane averages its strains along warp and weft.
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
// With means alone triangles would be free to stretch against one another; the part that they keep prevents
// it.
#pragma once

#include "sim/membrane/green_lagrange.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline constexpr double kMaxTriangleStiffness = 1000;  // triangles keep at most this [N/m]

// The stiffness that acts on strains of triangles, and that on means at nodes (without shear).
struct MembraneSplit {
  MembraneStiffness<double> faces, nodes;
  bool averages = false;  // true if there are nodes
};

// Splits the stiffness.  Nothing is averaged if `element` is constant, or if warp and weft have at most 1
// kN/m, their stops included.  Both parts are positive semidefinite.
MembraneSplit split_membrane(const Fabric& fabric, MembraneElement element);

// Return the stops on strains of triangles, and those on means at nodes.
InPlaneStops stops_of_faces(const Fabric& fabric, const MembraneSplit& split);
InPlaneStops stops_of_nodes(const Fabric& fabric, const MembraneSplit& split);

// A vertex is one node, or several where panels are sewn or touch: each node has the triangles that are
// connected through edges within a panel.
struct MembraneNodes {
  std::vector<double> area;              // A_v [m^2]
  std::vector<Eigen::Vector3i> of_face;  // the node at each corner
  Adjacency faces;                       // for each node 3*face + corner there
  Adjacency ring;                        // for each node the vertices of its triangles, ascending
  // For each item of `ring`: 3*face + corner where its vertex is in these triangles.
  Adjacency corners;

  int count() const { return static_cast<int>(area.size()); }
};
MembraneNodes membrane_nodes(const ClothMesh& mesh);

// Returns the off-diagonal blocks of the membrane's matrix: vertices that share a triangle, and with nodes a
// ring.
Adjacency membrane_couplings(const ClothMesh& mesh, const Fabric& fabric, MembraneElement element);

}  // namespace hysteron
