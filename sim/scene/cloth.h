// The cloth of a scene: its mesh at rest, where it starts, and which vertices are held.
#pragma once

#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

struct Cloth {
  ClothMesh mesh;
  std::vector<Eigen::Vector3d> start;  // positions at t = 0 [m]
  std::vector<int> pin;                // per vertex: index of its pin in the scene, -1 = free

  // Vertices that no force moves at `time` [s].
  std::vector<char> held(const Scene& scene, double time) const;
  // Middles of the bending elements at rest [m]: of hinges (dimension 1) or of faces (3).
  std::vector<Eigen::Vector3d> element_centers(int dimension) const;
};

// With a slack of 1 nm, so that corners meet grid vertices in spite of rounding.
bool is_in_box(const Eigen::Vector3d& x, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Builds or reads the mesh, places it and resolves the pins.  Error::request for impossible meshes and for
// pins that hold no vertex.
Cloth make_cloth(const Scene& scene);
// The same with a mesh of the caller's in place of the scene's.
Cloth place_cloth(const Scene& scene, ClothMesh mesh);

}  // namespace hysteron
