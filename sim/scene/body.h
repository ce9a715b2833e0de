// Obstacles of kind mesh: bodies of triangles that are read from files, placed and moved by a scene.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/body_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline bool is_body(const Obstacle& o) { return o.kind == ObstacleKind::mesh; }

// Reads the bodies of a scene that are not there yet.  Throws Error::system for files that cannot be read;
// Error::invalid_input, naming file and key, for files that hold no surface (read_body(),
// sim/mesh/body_file.h) and for bodies that are larger or smaller than any that cloth lies on.
void load_bodies(Scene& scene);

// Returns where the vertices of an obstacle of kind mesh are at `time` [s] in the world [m]: those of its
// mesh, moved by `center`, then by its motion.  Throws Error::invalid_input if it has no mesh.
std::vector<Eigen::Vector3d> body_positions(const Obstacle& obstacle, double time);

// Warnings about bodies that were probably not meant so.

// Returns a sentence for each doubtful body: one that passes through itself, in the first of up to twelve
// frames; a closed one whose triangles face inward, so that it is a hollow; a sequence in which a vertex goes
// farther from one frame to the next than animations do, or whose files have no even numbers.
std::vector<std::string> body_warnings(const Scene& scene);
// Returns a line for each body, for --explain: "obstacle[0]: mesh torso.obj, 1280 triangles, 642 vertices,
// closed, 0.42 x 0.3 x 0.9 m, 48 frames in 1.567 s".
std::vector<std::string> body_lines(const Scene& scene);

}  // namespace hysteron
