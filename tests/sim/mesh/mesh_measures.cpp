#include "tests/sim/mesh/mesh_measures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace hysteron::test {

double total_area(const ClothMesh& mesh) {
  double sum = 0;
  for (const double area : mesh.face_area) sum += area;
  return sum;
}

double least_angle(const ClothMesh& mesh) {
  double largest_cosine = -1;
  for (const auto& t : mesh.face) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d a = mesh.rest[t[(i + 1) % 3]] - mesh.rest[t[i]];
      const Eigen::Vector3d b = mesh.rest[t[(i + 2) % 3]] - mesh.rest[t[i]];
      largest_cosine = std::max(largest_cosine, a.dot(b) / (a.norm() * b.norm()));
    }
  }
  return std::acos(largest_cosine) * 180 / std::numbers::pi;
}

int euler_characteristic(const ClothMesh& mesh) {
  return mesh.vertices() - static_cast<int>(mesh.edge.size()) + mesh.faces();
}

std::set<int> boundary_vertices(const ClothMesh& mesh) {
  std::set<int> found;
  for (const Edge& e : mesh.edge)
    if (!e.interior()) found.insert({e.p2, e.p3});
  return found;
}

std::uint64_t fingerprint(const ClothMesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto mix = [&](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (word >> (8 * byte) & 255)) * 0x100000001b3u;
  };
  for (const auto& x : mesh.rest)
    for (const double c : x) mix(std::bit_cast<std::uint64_t>(c));
  for (const auto& t : mesh.face)
    for (const int v : t) mix(static_cast<std::uint64_t>(v));
  return hash;
}

}  // namespace hysteron::test
