// The cloth of a scene: its mesh at rest, where it starts, and which vertices are held.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

struct Cloth {
  ClothMesh mesh;
  std::vector<Eigen::Vector3d> start;  // positions at t = 0 [m]
  std::vector<int> pin;                // per vertex: the scene's pin that holds it at t = 0, -1 = free
  std::vector<std::vector<int>> pin_vertices;  // per pin: its vertices
  std::vector<std::string> warnings;           // what is doubtful about it, a sentence each

  // Per vertex: the pin that holds it at `time` [s], -1 = free.
  std::vector<int> pins(const Scene& scene, double time) const;
  // Vertices that no force moves at `time` [s], and those that none moves from t = 0 to the scene's end.
  std::vector<char> held(const Scene& scene, double time) const;
  std::vector<char> held_throughout(const Scene& scene) const;
  // Middles of the bending elements at rest [m]: of hinges (dimension 1) or of faces (3).
  std::vector<Eigen::Vector3d> element_centers(int dimension) const;
};

// The vertex of the flat cloth that is nearest to a point, and how far the point lies beside the cloth [m]; 0
// on it: no point of a triangle is farther from its nearest corner than its longest side is long.
struct NearestVertex {
  int vertex = 0;
  double beside = 0;
};
NearestVertex nearest_vertex(const ClothMesh& mesh, const Eigen::Vector3d& point);
// With a slack of 1 nm, so that corners meet grid vertices in spite of rounding.
bool is_in_box(const Eigen::Vector3d& x, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Builds or reads the mesh, places it and resolves the pins.  Error::invalid_input for impossible meshes and
// for pins that hold no vertex.
Cloth make_cloth(const Scene& scene);
// The same with a mesh of the caller's in place of the scene's.
Cloth place_cloth(const Scene& scene, ClothMesh mesh);

// Whether a cloth can be what was meant: the commonest mistake of a mesh is its unit of length.

// A sentence for each: size, weight or edges that no cloth of that fabric has, with the units in which it
// would be one; a start that stretches it; a start whose history no file holds.  `start` [m] is where the
// vertices of the mesh start.
std::vector<std::string> cloth_doubts(const Scene& scene, const ClothMesh& mesh,
                                      const std::vector<Eigen::Vector3d>& start);

// Where the coordinates of a simulation begin.  Far from the world's origin the rounding of a position, above
// all in single precision, is that of the distance and not of the cloth: there positions are relative to
// where the cloth starts.

// The middle of these positions; zero, exactly, where the world's origin is within kLocalBeyond of their
// diagonals [m].
inline constexpr double kLocalBeyond = 10;
Eigen::Vector3d local_origin(const std::vector<Eigen::Vector3d>& x);

// The same with all positions relative to `origin` [m].  What is chosen on the flat cloth, and keyframes,
// which are relative to the start, stay as they are.
Scene seen_from(const Eigen::Vector3d& origin, Scene scene);
Cloth seen_from(const Eigen::Vector3d& origin, Cloth cloth);

// What rounding in the scene's precision makes of these positions in the world [m], where cloth has gone
// farthest from its start: their distance from the next number [m].
double resolution(const Scene& scene, const Cloth& cloth, const std::vector<Eigen::Vector3d>& x);

}  // namespace hysteron
