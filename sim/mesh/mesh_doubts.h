// What is doubtful about a cloth that a file holds, though it can be simulated: what looks like one surface
// and is several.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/topology.h"

namespace hysteron {

// A sentence for each of these that the mesh has, with how many there are and where the first one stands:
//
//   several parts, or no hinge    parts of the surface that share no edge; nothing of a lone triangle bends
//   coincident boundary vertices  exporters write them along seams and between triangles of a "soup"
//   T-junctions                   a boundary vertex within the boundary edge of a triangle that ends not
//   there fans that meet in a vertex    two corners of the surface hang together by a point, about which both
//   turn
//
// A slit, a second cloth or an eyelet may be meant: none of these is refused.  The mesh has its topology.
std::vector<std::string> mesh_doubts(const ClothMesh& mesh, const MeshNames& names);

}  // namespace hysteron
