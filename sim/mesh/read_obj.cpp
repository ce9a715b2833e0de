// Wavefront OBJ in, as a cloth.
#include <cmath>
#include <sstream>

#include "sim/base/error.h"
#include "sim/mesh/mesh_doubts.h"
#include "sim/mesh/obj_soup.h"
#include "sim/mesh/topology.h"

namespace hysteron {
namespace {

void check_weld(double distance, const std::string& what) {
  if (distance >= 0 && std::isfinite(distance)) return;
  std::ostringstream text;
  text << what << ": weld = " << distance << " m must be >= 0";
  throw Error::request(text.str());
}

// No two triangles are such a quad.
void check_quads(const ObjSoup& soup, const std::string& what) {
  if (soup.crossed_line.empty()) return;
  throw Error::request(what + ": line " + std::to_string(soup.crossed_line.front()) +
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

// Texture coordinates become the pattern where each vertex has one.  Along seams it has several: then each
// triangle keeps those of its own corners.
void take_pattern(const ObjSoup& soup, ClothMesh& mesh) {
  if (!has_texture(soup)) return;
  mesh.pattern = vertex_texture(soup, mesh.face, mesh.rest.size());
  for (int f = 0; mesh.pattern.empty() && f < mesh.faces(); ++f)
    mesh.panel.push_back({*soup.uv[f][0], *soup.uv[f][1], *soup.uv[f][2]});
}

}  // namespace

ClothMesh read_obj(const std::string& file, double weld, LengthUnit unit, std::vector<std::string>* doubts) {
  MeshNames names{"mesh " + file, {}, {}};
  check_weld(weld, names.what);
  ObjSoup soup = read_obj_soup(file, names.what);
  check_quads(soup, names.what);
  for (Eigen::Vector3d& x : soup.vertex)
    for (double& length : x) length = in_metres(length, unit);
  ClothMesh mesh;
  mesh.face = soup.face;
  names.face_line = soup.face_line;
  weld_vertices(weld, soup, mesh, names);
  take_pattern(soup, mesh);
  build_topology(mesh, names);
  if (doubts)
    for (const std::string& doubt : mesh_doubts(mesh, names)) doubts->push_back(doubt);
  return mesh;
}

}  // namespace hysteron
