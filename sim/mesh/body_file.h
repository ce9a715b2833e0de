// Bodies of triangles from the files of other programs.
#pragma once

#include <string>

#include "sim/mesh/body_mesh.h"
#include "sim/mesh/length_unit.h"

namespace hysteron {

struct BodyFiles {
  std::string file;      // OBJ or PLY: the triangles; where there is no sequence, the positions, too
  std::string sequence;  // files by a pattern, "walk/*.obj" (glob(7)), or a point cache; "": none
  LengthUnit unit = LengthUnit::metre;
  double fps = 0;  // frames a second; 0: as the cache has it
};

// Quads are cut as in `file`; vertices that no face uses are left out.  Files of a sequence are in the order
// of their names, numbers in them by value, and have the vertices and faces of `file` in the same order.
// The first frame is the body's at t = 0, whatever number or time it has.  Where nothing says when the others
// are, the body does not move.
// Throws Error::system for files that cannot be read; Error::invalid_input, naming the file, for what
// read_surface(), read_point_cache() and build_topology() refuse, for a pattern that no file has, for another
// number of vertices, other faces or, in any frame, degenerate triangles.
BodyMesh read_body(const BodyFiles& files);

}  // namespace hysteron
