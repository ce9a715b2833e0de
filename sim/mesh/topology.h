// Builds the topology of a mesh whose triangles and vertices come from the lines of a file.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Names the parts of a mesh in messages: by the line of the file, or else counted from 0.
struct MeshNames {
  std::string what;              // names the mesh ("mesh shirt.obj")
  std::vector<int> face_line;    // per triangle, or empty
  std::vector<int> vertex_line;  // per vertex, or empty

  std::string triangle(int f) const;
  std::string vertex(int v) const;
};

// Does the same as build_topology(mesh, what), with the file's lines in its messages.
void build_topology(ClothMesh& mesh, const MeshNames& names);

// Fills in the areas alone, from `face` and `rest`.  Throws Error::invalid_input for degenerate triangles.
void measure_areas(ClothMesh& mesh, const MeshNames& names);

// These warnings concern a cloth in a file that can be simulated, but is doubtful: it looks like one surface
// and is several.

// Returns a sentence for each of these features of the mesh, with their number and the place of the first
// one:
//
//   several parts, or no hinge    parts of the surface that share no edge; nothing of a lone triangle bends
//   coincident boundary vertices  exporters write them along seams and between triangles of a "soup"
//   T-junctions                   a boundary vertex within the boundary edge of a triangle, where that does
//                                 not end
//   fans that meet in a vertex    corners of the surface hang together by a point, about which both turn
//
// A slit, a second cloth or an eyelet may be meant: none of these is refused.  The mesh has its topology.
std::vector<std::string> mesh_warnings(const ClothMesh& mesh, const MeshNames& names);

// This joins vertices that lie on each other, as exporters leave them along seams.

// Returns for each point the lowest-numbered kept point closer than `distance` [m], or itself, which is then
// kept.  Kept points are at least `distance` apart.  The expected time is linear in the points (spatial
// hash).
std::vector<int> nearby_representatives(const std::vector<Eigen::Vector3d>& points, double distance);

}  // namespace hysteron
