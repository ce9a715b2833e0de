// The cloth of a scene: its mesh at rest, its positions at the start, and its pinned vertices.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

struct Cloth {
  ClothMesh mesh;
  std::vector<Eigen::Vector3d> start;          // positions at t = 0 [m]
  std::vector<int> pin;                        // per vertex: the scene's pin that holds it at t = 0, -1: free
  std::vector<std::vector<int>> pin_vertices;  // per pin: its vertices
  std::vector<std::string> warnings;           // doubts about the cloth, a sentence each

  // Returns for each vertex the pin that holds it at `time` [s], -1: free.
  std::vector<int> pins(const Scene& scene, double time) const;
  // Return 1 for each vertex that no force moves: at `time` [s], and from t = 0 to the scene's end.
  std::vector<char> held(const Scene& scene, double time) const;
  std::vector<char> held_throughout(const Scene& scene) const;
  // Returns the middles of the bending elements at rest [m]: hinges (dimension 1) or faces (3).
  std::vector<Eigen::Vector3d> element_centers(int dimension) const;
};

// The vertex of the flat cloth that is nearest to a point, and how far the point lies beside the cloth [m].
// A point on the cloth has distance 0: no point of a triangle is farther from its nearest corner than its
// longest side is long.
struct NearestVertex {
  int vertex = 0;
  double beside = 0;  // [m]
};
NearestVertex nearest_vertex(const ClothMesh& mesh, const Eigen::Vector3d& point);
// Allows a slack of 1 nm, so that box corners meet grid vertices in spite of rounding.
bool is_in_box(const Eigen::Vector3d& x, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Builds or reads the mesh, places it and resolves the pins.  Error::invalid_input for impossible meshes and
// for pins that hold no vertex.
Cloth make_cloth(const Scene& scene);
// Makes the same from the caller's mesh in place of the scene's.
Cloth place_cloth(const Scene& scene, ClothMesh mesh);

// Warnings about cloths that were probably not meant so: the commonest mistake of a mesh is its unit of
// length.

// Returns a sentence for each doubt: size, weight or edges that no cloth of that fabric has, with the units
// in which they would be usual; a start that stretches the cloth; a start whose history no file holds.
// `start` [m] is where the vertices of the mesh start.
std::vector<std::string> cloth_warnings(const Scene& scene, const ClothMesh& mesh,
                                        const std::vector<Eigen::Vector3d>& start);

// The origin of a simulation's coordinates.  Far from the world's origin a position's rounding, above all in
// single precision, grows with the distance: there positions are relative to where the cloth starts.

// Returns the middle of these positions [m]; exactly zero where the world's origin is within kLocalBeyond of
// their diagonals.
inline constexpr double kLocalBeyond = 10;
Eigen::Vector3d local_origin(const std::vector<Eigen::Vector3d>& x);

// Return the scene or cloth with all positions relative to `origin` [m].  Selections on the flat cloth, and
// keyframes, which are relative to the start, stay as they are.
Scene relative_to(const Eigen::Vector3d& origin, Scene scene);
Cloth relative_to(const Eigen::Vector3d& origin, Cloth cloth);

// Returns the spacing of floating-point numbers [m], in the scene's precision, at the coordinate that is
// farthest from the simulation's origin.
double resolution(const Scene& scene, const Cloth& cloth, const std::vector<Eigen::Vector3d>& x);

}  // namespace hysteron
