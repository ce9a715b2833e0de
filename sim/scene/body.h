// Obstacles of kind mesh: bodies of triangles that files hold, as a scene places and moves them.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/body_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline bool is_body(const Obstacle& o) { return o.kind == ObstacleKind::mesh; }

// Reads the bodies of a scene that are not there yet.  Throws Error::system for files that cannot be read;
// Error::invalid_input, naming file and key, for what is no surface (read_body(), sim/mesh/body_file.h) and
// for bodies that are larger or smaller than any that cloth lies on.
void load_bodies(Scene& scene);

// Where the vertices of an obstacle of kind mesh are at `time` [s] in the world [m]: those of its mesh, moved
// by `center`, then by its motion.  Error::invalid_input where it has no mesh.
std::vector<Eigen::Vector3d> body_positions(const Obstacle& obstacle, double time);

}  // namespace hysteron
