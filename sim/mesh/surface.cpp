#include "sim/mesh/surface.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/file_extension.h"
#include "sim/mesh/obj_soup.h"
#include "sim/mesh/ply_header.h"

namespace hysteron {
namespace {

// Leaves out vertices, and their values, that no face uses.
Surface without_loose_vertices(Surface surface) {
  std::vector<int> number(surface.vertex.size(), -1);
  for (const Eigen::Vector3i& face : surface.face)
    for (const int v : face) number[v] = 0;
  int kept = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    surface.vertex[kept] = surface.vertex[v];
    if (!surface.pattern.empty()) surface.pattern[kept] = surface.pattern[v];
    if (!surface.curvature.empty()) surface.curvature[kept] = surface.curvature[v];
    number[v] = kept++;
  }
  surface.vertex.resize(kept);
  if (!surface.pattern.empty()) surface.pattern.resize(kept);
  if (!surface.curvature.empty()) surface.curvature.resize(kept);
  for (Eigen::Vector3i& face : surface.face) face = {number[face[0]], number[face[1]], number[face[2]]};
  return surface;
}

void check_ply_header(const PlyHeader& header, const std::string& what) {
  const PlyElement* const vertex = header.find("vertex", "vertices");
  const PlyElement* const face = header.find("face", "faces");
  if (!vertex || !face || face->count == 0) throw Error::invalid_input(what + ": no faces");
  for (const char* axis : {"x", "y", "z"}) {
    const PlyProperty* const x = vertex->find(axis);
    if (!x || !x->is_real())
      throw Error::invalid_input(what + ": line " + std::to_string(vertex->line) +
                                 ": the vertices need x, y and z of type float or double");
  }
  const PlyProperty* const curvature = vertex->find("curvature");
  if (curvature && !curvature->is_real())
    throw Error::invalid_input(what + ": line " + std::to_string(vertex->line) +
                               ": the vertices' curvature must be of type float or double");
  const PlyProperty* list = face->find("vertex_indices");
  if (!list) list = face->find("vertex_index");
  if (!list || !list->is_list_of_indices())
    throw Error::invalid_input(what + ": line " + std::to_string(face->line) +
                               ": the faces need a list vertex_indices or vertex_index of type int or uint");
}

void check_polygon(const std::vector<std::int64_t>& corner, std::size_t vertices, const std::string& which) {
  if (corner.size() != 3 && corner.size() != 4)
    throw Error::invalid_input(which + " has " + std::to_string(corner.size()) +
                               " corners; allowed are triangles and quads, triangulate the mesh first");
  for (const std::int64_t v : corner)
    if (v < 0 || v >= static_cast<std::int64_t>(vertices))
      throw Error::invalid_input(which + " uses vertex " + std::to_string(v) + "; the file has " +
                                 std::to_string(vertices) + ", counted from 0");
}

void add_polygon(const std::vector<std::int64_t>& corner, Surface& surface) {
  const auto v = [&](int i) { return static_cast<int>(corner[i]); };
  if (corner.size() == 3) {
    surface.face.emplace_back(v(0), v(1), v(2));
    return;
  }
  const auto x = [&](int i) { return surface.vertex[corner[i]]; };
  if (is_cut_from_first(x(0), x(1), x(2), x(3))) {
    surface.face.emplace_back(v(0), v(1), v(2));
    surface.face.emplace_back(v(0), v(2), v(3));
  } else {
    surface.face.emplace_back(v(0), v(1), v(3));
    surface.face.emplace_back(v(1), v(2), v(3));
  }
}

Surface read_whole_obj(const std::string& file) {
  const std::string what = "mesh " + file;
  ObjSoup soup = read_obj_soup(file, what);
  if (soup.face.empty()) throw Error::invalid_input(what + ": no faces");
  Surface surface;
  continue_texture(soup);
  if (has_texture(soup)) surface.pattern = vertex_texture(soup, soup.face, soup.vertex.size());
  surface.vertex = std::move(soup.vertex);
  surface.face = std::move(soup.face);
  return surface;
}

Surface read_whole_ply(const std::string& file) {
  const std::string what = "mesh " + file, text = whole_file(file, "cannot read mesh " + file);
  const PlyHeader header = read_ply_header(text, what);
  check_ply_header(header, what);
  PlyContent content = read_ply_content(text, header, what);
  for (std::size_t v = 0; v < content.vertex.size(); ++v)
    if (!content.vertex[v].allFinite())
      throw Error::invalid_input(what + ": vertex " + std::to_string(v) + " is not a finite number");
  Surface surface;
  surface.vertex = std::move(content.vertex);
  surface.curvature = std::move(content.curvature);
  for (std::size_t f = 0; f < content.face.size(); ++f) {
    check_polygon(content.face[f], surface.vertex.size(), what + ": face " + std::to_string(f));
    add_polygon(content.face[f], surface);
  }
  return surface;
}

}  // namespace

Surface read_obj_surface(const std::string& file) { return without_loose_vertices(read_whole_obj(file)); }

Surface read_ply(const std::string& file) { return without_loose_vertices(read_whole_ply(file)); }

Surface read_whole_surface(const std::string& file) {
  const std::string ending = file_extension(file);
  if (ending == ".obj") return read_whole_obj(file);
  if (ending == ".ply") return read_whole_ply(file);
  throw Error::invalid_input("mesh " + file + ": its name must end in .obj or .ply");
}

Surface read_surface(const std::string& file) { return without_loose_vertices(read_whole_surface(file)); }

}  // namespace hysteron
