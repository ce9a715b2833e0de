#include "sim/mesh/surface.h"

#include <utility>

#include "sim/base/error.h"
#include "sim/mesh/file_ending.h"
#include "sim/mesh/obj_soup.h"

namespace hysteron {
namespace {

Surface read_obj_surface(const std::string& file) {
  const std::string what = "mesh " + file;
  ObjSoup soup = read_obj_soup(file, what);
  if (soup.face.empty()) throw Error::invalid_input(what + ": no faces");
  Surface surface;
  if (has_texture(soup)) surface.pattern = vertex_texture(soup, soup.face, soup.vertex.size());
  surface.vertex = std::move(soup.vertex);
  surface.face = std::move(soup.face);
  return without_loose_vertices(std::move(surface));
}

}  // namespace

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

Surface read_surface(const std::string& file) {
  const std::string ending = file_extension(file);
  if (ending == ".obj") return read_obj_surface(file);
  if (ending == ".ply") return read_ply(file);
  throw Error::invalid_input("mesh " + file + ": its name must end in .obj or .ply");
}

}  // namespace hysteron
