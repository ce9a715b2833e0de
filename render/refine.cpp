#include "render/refine.h"

#include <array>
#include <map>
#include <string>
#include <utility>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

using Index = std::uint32_t;

// Halves the sides that are too long, each once.
class Halving {
 public:
  Halving(TriangleMesh& mesh, float longest) : mesh_(mesh), longest_(longest) {}

  // The vertex halfway from a to b; a where the side is short enough.
  Index middle(Index a, Index b) {
    if ((mesh_.positions[a] - mesh_.positions[b]).norm() <= longest_) return a;
    const auto [entry, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<Index>(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.emplace_back(0.5f * (mesh_.positions[a] + mesh_.positions[b]));
      mesh_.normals.emplace_back((mesh_.normals[a] + mesh_.normals[b]).normalized());
    }
    return entry->second;
  }

  bool any() const { return !middles_.empty(); }

 private:
  TriangleMesh& mesh_;
  float longest_;
  std::map<std::pair<Index, Index>, Index> middles_;
};

void add(std::vector<Index>& triangles, Index a, Index b, Index c) {
  triangles.insert(triangles.end(), {a, b, c});
}

// Splits the triangle (a, b, c) at the middles of its sides ab, bc, ca; a middle that is the side's first
// vertex is none.
void split(std::vector<Index>& triangles, std::array<Index, 3> corner, std::array<Index, 3> middle) {
  const auto halved = [&](int k) { return middle[k] != corner[k]; };
  const int count = halved(0) + halved(1) + halved(2);
  // Turned until side ab is halved and, of two, ca is not.
  while (count > 0 && (!halved(0) || (count == 2 && halved(2)))) {
    corner = {corner[1], corner[2], corner[0]};
    middle = {middle[1], middle[2], middle[0]};
  }
  const auto [a, b, c] = corner;
  const auto [ab, bc, ca] = middle;
  if (count == 0) return add(triangles, a, b, c);
  if (count == 1) {
    add(triangles, a, ab, c);
    return add(triangles, ab, b, c);
  }
  add(triangles, ab, b, bc);
  if (count == 2) {
    add(triangles, a, ab, bc);
    return add(triangles, a, bc, c);
  }
  add(triangles, a, ab, ca);
  add(triangles, ca, bc, c);
  add(triangles, ab, bc, ca);
}

}  // namespace

TriangleMesh refined(TriangleMesh mesh, float longest) {
  if (!(longest > 0))
    throw Error::request("refining a mesh: longest side = " + std::to_string(longest) + " m must be > 0");
  for (bool changed = true; changed;) {
    Halving halving(mesh, longest);
    std::vector<Index> triangles;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const std::array<Index, 3> corner{mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]};
      const auto [a, b, c] = corner;
      split(triangles, corner, {halving.middle(a, b), halving.middle(b, c), halving.middle(c, a)});
    }
    mesh.triangles = std::move(triangles);
    changed = halving.any();
  }
  return mesh;
}

}  // namespace hysteron::render
