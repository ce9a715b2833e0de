// The common parts of the builders of flat meshes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A request for more triangles is a mistake, and beyond what the Delaunay grid resolves.
inline constexpr int kMaxTriangles = 10'000'000;

// Throws Error::invalid_input "<what> mesh: <name> = <value> m must be > 0" unless it is a positive finite
// number.
void check_length(const std::string& what, const std::string& name, double value);
// Throws Error::invalid_input unless 2 <= triangles <= kMaxTriangles.
void check_triangles(const std::string& what, int triangles);

// Returns the height of a row of cells over their width, for regular cells.
double row_height(MeshFamily family);

// Is the square cell (i, j) of a structured family cut from its lower left to its upper right corner?
bool rising_diagonal(MeshFamily family, int i, int j);

// Makes the mesh of these points in z = 0, triangles ordered by their lowest vertex, with its topology.
ClothMesh flat_mesh(const std::vector<Eigen::Vector2d>& points, std::vector<Eigen::Vector3i> triangles,
                    const std::string& what);

// Finer meshes of the same surface have each triangle cut into four at the middles of its sides.

// Returns the subdivided cloth, at rest and in texture coordinates: first its vertices, then the middle of
// each edge; the triangles of each triangle one after another.  Throws Error::invalid_input beyond 10 million
// triangles.
ClothMesh subdivided(const ClothMesh& mesh);

// Returns the positions of the vertices [m], followed by those of the edges' middles.
std::vector<Eigen::Vector3d> subdivide(const ClothMesh& mesh, std::vector<Eigen::Vector3d> x);

}  // namespace hysteron
