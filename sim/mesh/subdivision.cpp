#include "sim/mesh/subdivision.h"

#include "sim/base/error.h"
#include "sim/mesh/builders.h"

namespace hysteron {
namespace {

constexpr int kPieces = 4;  // of a triangle

// By the vertices of the whole and the middles m_i opposite to them:
//
//         2
//        /  \            .
//      m1----m0
//     /  \  /  \         .
//    0----m2----1
template <class Point>
std::array<std::array<Point, 3>, kPieces> pieces(const std::array<Point, 3>& at,
                                                 const std::array<Point, 3>& m) {
  return {{{at[0], m[2], m[1]}, {m[2], at[1], m[0]}, {m[1], m[0], at[2]}, {m[0], m[1], m[2]}}};
}

}  // namespace

std::vector<Eigen::Vector3d> with_middles(const ClothMesh& mesh, std::vector<Eigen::Vector3d> x) {
  x.reserve(x.size() + mesh.edge.size());
  for (const Edge& e : mesh.edge) x.push_back((x[e.p2] + x[e.p3]) / 2);
  return x;
}

ClothMesh subdivided(const ClothMesh& mesh) {
  if (mesh.faces() > kMostTriangles / kPieces)
    throw Error::request("subdivided mesh: 4 times " + std::to_string(mesh.faces()) +
                         " triangles must be at most " + std::to_string(kMostTriangles));
  ClothMesh fine;
  fine.warp_axis = mesh.warp_axis;
  fine.sewn = mesh.sewn;
  fine.rest = with_middles(mesh, mesh.rest);
  fine.pattern = mesh.pattern;
  if (!mesh.pattern.empty())
    for (const Edge& e : mesh.edge) fine.pattern.push_back((mesh.pattern[e.p2] + mesh.pattern[e.p3]) / 2);
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto& [a, b, c] = mesh.face_edge[f];
    const int n = mesh.vertices();
    const std::array corner{mesh.face[f][0], mesh.face[f][1], mesh.face[f][2]};
    for (const auto& [i, j, k] : pieces<int>(corner, {n + a, n + b, n + c})) fine.face.emplace_back(i, j, k);
    if (mesh.panel.empty()) continue;
    const auto& at = mesh.panel[f];
    for (const auto& piece :
         pieces<Eigen::Vector2d>(at, {(at[1] + at[2]) / 2, (at[2] + at[0]) / 2, (at[0] + at[1]) / 2}))
      fine.panel.push_back(piece);
  }
  build_topology(fine, "subdivided mesh");
  return fine;
}

}  // namespace hysteron
