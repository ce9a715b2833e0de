// Reads a Wavefront OBJ as a cloth.
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/mesh/obj_soup.h"
#include "sim/mesh/topology.h"

namespace hysteron {
namespace {

void check_weld(double distance, const std::string& what) {
  if (distance >= 0 && std::isfinite(distance)) return;
  throw Error::invalid_input(what + ": weld = " + number_text(distance, 6) + " m must be >= 0");
}

// Refuses quads that cross themselves, which no two triangles can represent.
void check_quads(const ObjSoup& soup, const std::string& what) {
  if (soup.crossed_line.empty()) return;
  throw Error::invalid_input(what + ": line " + std::to_string(soup.crossed_line.front()) +
                             ": sides of the quad cross: its corners must follow one another around it");
}

// Renumbers the soup's vertices to the kept ones; fills rest and the vertices' lines.
void weld_vertices(double distance, const ObjSoup& soup, ClothMesh& mesh, MeshNames& names) {
  std::vector<int> number(soup.vertex.size());
  std::vector<int> representative;
  if (distance > 0) representative = nearby_representatives(soup.vertex, distance);
  for (std::size_t v = 0; v < soup.vertex.size(); ++v) {
    if (distance > 0 && representative[v] != static_cast<int>(v)) {
      number[v] = number[representative[v]];
      continue;
    }
    number[v] = mesh.vertices();
    mesh.rest.push_back(soup.vertex[v]);
    names.vertex_line.push_back(soup.vertex_line[v]);
  }
  for (auto& face : mesh.face) face = {number[face[0]], number[face[1]], number[face[2]]};
}

// Tells which faces lack texture coordinates: "the face has no texture coordinates, nor have 3 further
// triangles".
std::string without_texture(const std::string& what, const std::vector<int>& lines) {
  return what + ": line " + std::to_string(lines.front()) + ": the face has no texture coordinates" +
         (lines.size() > 1 ? ", nor have " + std::to_string(lines.size() - 1) + " further triangles" : "");
}

// Warns if only some faces have texture coordinates, which `continued` ones got from their neighbours.
std::string texture_warning(const ObjSoup& soup, const std::vector<int>& continued, const std::string& what) {
  std::vector<int> without;
  for (std::size_t f = 0; f < soup.uv.size(); ++f)
    if (!is_whole(soup.uv[f])) without.push_back(soup.face_line[f]);
  if (without.size() == soup.uv.size()) return "";
  if (!without.empty())
    return without_texture(what, without) + ", and no neighbour to tell them, while " +
           std::to_string(soup.uv.size() - without.size()) +
           " others have: none are used, and warp is along x at rest; give them to all faces";
  if (continued.empty()) return "";
  return without_texture(what, continued) + ": those of neighbours go on there, and warp with them";
}

// Makes the texture coordinates the pattern where each vertex has one.  Along seams it has several: then each
// triangle keeps those of its own corners.
void take_pattern(const ObjSoup& soup, ClothMesh& mesh) {
  if (!has_texture(soup)) return;
  mesh.pattern = vertex_texture(soup, mesh.face, mesh.rest.size());
  for (int f = 0; mesh.pattern.empty() && f < mesh.faces(); ++f)
    mesh.panel.push_back({*soup.uv[f][0], *soup.uv[f][1], *soup.uv[f][2]});
}

}  // namespace

ClothMesh read_obj(const std::string& file, double weld, LengthUnit unit,
                   std::vector<std::string>* warnings) {
  MeshNames names{"mesh " + file, {}, {}};
  check_weld(weld, names.what);
  ObjSoup soup = read_obj_soup(file, names.what);
  check_quads(soup, names.what);
  const std::vector<int> continued = continue_texture(soup);
  for (Eigen::Vector3d& x : soup.vertex)
    for (double& length : x) length = in_metres(length, unit);
  ClothMesh mesh;
  mesh.face = soup.face;
  names.face_line = soup.face_line;
  weld_vertices(weld, soup, mesh, names);
  take_pattern(soup, mesh);
  build_topology(mesh, names);
  if (const std::string warning = texture_warning(soup, continued, names.what); warnings && !warning.empty())
    warnings->push_back(warning);
  if (warnings)
    for (const std::string& warning : mesh_warnings(mesh, names)) warnings->push_back(warning);
  return mesh;
}

}  // namespace hysteron
