// The triangles of a Wavefront OBJ with their lines in the file, before any check of their topology.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

// These cut a quadrilateral into two triangles.

// Decides how to cut a quad a, b, c, d: along its shorter diagonal, unless only the other one lies inside it.
// Returns true for a-c, into (a, b, c) and (a, c, d); false for b-d, into (a, b, d) and (b, c, d).
inline bool is_cut_from_first(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                              const Eigen::Vector3d& d) {
  const auto folded = [](const auto& p, const auto& q, const auto& r, const auto& s) {  // along p-r
    return (q - p).cross(r - p).dot((r - p).cross(s - p)) <= 0;
  };
  const bool first = folded(a, b, c, d), second = folded(b, c, d, a);
  if (first != second) return second;
  return (c - a).norm() <= (d - b).norm();
}

// Does the side a-b meet c-d, or b-c meet d-a, as where the corners are not given in their order around?
inline bool crosses_itself(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                           const Eigen::Vector3d& d) {
  constexpr double kNear = 0.1;  // over the side's length: the quad need not be plane
  const auto meet = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                       const Eigen::Vector3d& s) {
    const Eigen::Vector3d u = q - p, v = s - r, w = r - p;
    const double uv = u.dot(v), det = u.squaredNorm() * v.squaredNorm() - uv * uv;
    const double along = w.dot(u) * v.squaredNorm() - w.dot(v) * uv,
                 other = w.dot(u) * uv - w.dot(v) * u.squaredNorm();
    if (along <= 0 || along >= det || other <= 0 || other >= det) return false;
    return (w + other / det * v - along / det * u).norm() < kNear * std::min(u.norm(), v.norm());
  };
  return meet(a, b, c, d) || meet(b, c, d, a);
}

using Uv = std::optional<Eigen::Vector2d>;

// Has every corner a texture coordinate?
inline bool is_whole(const std::array<Uv, 3>& corners) {
  return std::all_of(corners.begin(), corners.end(), [](const Uv& at) { return at.has_value(); });
}

struct ObjSoup {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<int> vertex_line;
  std::vector<Eigen::Vector3i> face;  // quads are cut
  // Texture coordinates at each triangle's corners; one that the file leaves out is taken from its vertex in
  // other faces, if these have one alone.
  std::vector<std::array<Uv, 3>> uv;
  std::vector<int> face_line;
  std::vector<int> crossed_line;  // quads with two sides that cross
};

// Reads an OBJ; `what` names the mesh in messages.  Throws Error::system for a file that cannot be read,
// Error::invalid_input for files that are not OBJ, malformed lines, numbers that are not finite, and faces
// that are neither triangles nor quads.
ObjSoup read_obj_soup(const std::string& file, const std::string& what);

// Gives corners without a texture coordinate that of their vertex in other triangles, if it has one alone.
// read_obj_soup() does so.
void share_texture(ObjSoup& soup);
// Makes triangles that still lack texture coordinates continue the texture of a neighbour beyond the edge
// between them, as if they lay in its plane.  Returns the lines of those that do.
std::vector<int> continue_texture(ObjSoup& soup);
// Has every corner a texture coordinate?
bool has_texture(const ObjSoup& soup);
// Returns the texture coordinate of each vertex of `face` (which may be numbered otherwise than the soup);
// zero where no face uses it.  Empty where a vertex has several, along seams.  The soup must have texture.
std::vector<Eigen::Vector2d> vertex_texture(const ObjSoup& soup, const std::vector<Eigen::Vector3i>& face,
                                            std::size_t vertices);

}  // namespace hysteron
