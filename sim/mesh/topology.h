// Building the topology of a mesh whose triangles and vertices come from the lines of a file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// How messages name the parts of a mesh: by the line of the file, or else counted from 0.
struct MeshNames {
  std::string what;              // names the mesh ("mesh shirt.obj")
  std::vector<int> face_line;    // per triangle, or empty
  std::vector<int> vertex_line;  // per vertex, or empty

  std::string triangle(int f) const;
  std::string vertex(int v) const;
};

// Derivative of the position by the first pattern coordinate over triangle f, whose corners have the pattern
// coordinates `at`; zero where these are degenerate.
Eigen::Vector3d pattern_warp(const ClothMesh& mesh, int f, const std::array<Eigen::Vector2d, 3>& at);

// As build_topology(mesh, what), with the file's lines in its messages.
void build_topology(ClothMesh& mesh, const MeshNames& names);

}  // namespace hysteron
