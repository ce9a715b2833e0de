#include "sim/mesh/garment.h"

#include "sim/base/error.h"

namespace hysteron {
namespace {

double signed_area(const ClothMesh& mesh, const Eigen::Vector3i& t) {
  const Eigen::Vector3d a = mesh.rest[t[1]] - mesh.rest[t[0]], b = mesh.rest[t[2]] - mesh.rest[t[0]];
  return (a.x() * b.y() - a.y() * b.x()) / 2;
}

}  // namespace

ClothMesh read_pattern(const std::string& file, double weld) {
  ClothMesh mesh = read_obj(file, weld);
  const std::string what = "mesh " + file;
  if (mesh.pattern.empty())
    throw Error::request(
        what + ": its texture coordinates are no flat cloth: " +
        (mesh.face_warp.empty() ? "corners have none" : "vertices have several, along seams"));
  for (int v = 0; v < mesh.vertices(); ++v) mesh.rest[v] = {mesh.pattern[v].x(), mesh.pattern[v].y(), 0};
  const bool mirrored = signed_area(mesh, mesh.face[0]) < 0;
  for (int f = 0; f < mesh.faces(); ++f)
    if ((signed_area(mesh, mesh.face[f]) < 0) != mirrored)
      throw Error::request(what + ": triangle " + std::to_string(f + 1) +
                           " is turned over in its texture coordinates, where the cloth must be flat");
  build_topology(mesh, what);
  return mesh;
}

std::vector<Eigen::Vector3d> read_start(const std::string& file, double weld, const ClothMesh& mesh) {
  const ClothMesh start = read_obj(file, weld);
  if (start.face == mesh.face && start.vertices() == mesh.vertices()) return start.rest;
  throw Error::request(
      "mesh " + file + " has " + std::to_string(start.vertices()) + " vertices and " +
      std::to_string(start.faces()) + " triangles; where cloth starts it must have the same as at rest, " +
      std::to_string(mesh.vertices()) + " and " + std::to_string(mesh.faces()) + ", in the same order");
}

}  // namespace hysteron
