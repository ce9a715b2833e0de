// Reads bodies of triangles from the files of other programs.
#pragma once

#include <string>

#include "sim/mesh/body_mesh.h"
#include "sim/mesh/length_unit.h"

namespace hysteron {

struct BodyFiles {
  std::string file;      // OBJ or PLY of the triangles, and of the positions if there is no sequence
  std::string sequence;  // files by a pattern, "walk/*.obj" (glob(7)), or a point cache; "": none
  LengthUnit unit = LengthUnit::metre;
  double fps = 0;  // frames per second; 0: the cache's times
};

// Reads a body.  Quads are cut as in `file`; vertices that no face uses are left out.  Files of a sequence
// are in the order of their names, numbers in them by value, and have the vertices and faces of `file` in the
// same order.  The first frame is the body's at t = 0, whatever number or time it has.  If nothing gives the
// times of the others, the body does not move.  Throws Error::system for files that cannot be read;
// Error::invalid_input, naming the file, for files that read_surface(), read_point_cache() or
// build_topology() refuse, for a pattern that no file matches, for another number of vertices, other faces
// or, in any frame, degenerate triangles.
BodyMesh read_body(const BodyFiles& files);

}  // namespace hysteron
