// The triangles of a Wavefront OBJ with the lines they stand on, before anything is asked of their topology.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

using Uv = std::optional<Eigen::Vector2d>;

struct ObjSoup {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<int> vertex_line;
  std::vector<Eigen::Vector3i> face;  // quads are cut
  std::vector<std::array<Uv, 3>> uv;  // texture coordinates at each triangle's corners
  std::vector<int> face_line;
  std::vector<int> crossed_line;  // of quads with two sides that cross
};

// `what` names the mesh in messages.  Throws Error::machine for a file that cannot be read, Error::request
// for what is no OBJ, malformed lines, numbers that are not finite, and faces that are neither triangles nor
// quads.
ObjSoup read_obj_soup(const std::string& file, const std::string& what);

// Whether every corner has a texture coordinate.
bool has_texture(const ObjSoup& soup);
// The texture coordinate of each vertex of `face` (which may be numbered otherwise than the soup); zero where
// no face uses it.  Empty where a vertex has several, along seams.  The soup has_texture().
std::vector<Eigen::Vector2d> vertex_texture(const ObjSoup& soup, const std::vector<Eigen::Vector3i>& face,
                                            std::size_t vertices);

}  // namespace hysteron
