// A surface of a file from any program: enough to be drawn, not yet a cloth that can be simulated.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace hysteron {

struct Surface {
  std::vector<Eigen::Vector3d> vertex;   // in the file's unit
  std::vector<Eigen::Vector3i> face;     // triangles, in the file's orientation
  std::vector<Eigen::Vector2d> pattern;  // texture coordinates per vertex; empty unless each has just one
  std::vector<double> curvature;         // per vertex, in the file's unit; empty: the file has none
};

// The functions below read triangles and quads (cut along the shorter diagonal), and leave out vertices that
// no face uses.  Edges of three faces, changes of orientation and triangles without area are taken as they
// are.  They throw Error::system for a file that cannot be read; Error::invalid_input, naming the file and
// the line or element, for malformed files, for faces of other sizes, and for no faces at all.

// Reads a Wavefront OBJ.  Numbers that are not finite are refused.
Surface read_obj_surface(const std::string& file);
// Reads a PLY, ASCII or binary of either byte order.  Takes the elements `vertex` with the properties x, y, z
// and `curvature` (float or double), and `face` with vertex_indices or vertex_index (int or uint).  Positions
// that are not finite are refused.
Surface read_ply(const std::string& file);
// Reads by the ending, .obj or .ply in letters of either case; Error::invalid_input for another one.
Surface read_surface(const std::string& file);
// Reads all vertices of the file, in its order.
Surface read_whole_surface(const std::string& file);

}  // namespace hysteron
