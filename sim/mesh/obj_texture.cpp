// Completes texture coordinates that an OBJ leaves out.
#include <deque>
#include <map>

#include "sim/mesh/obj_soup.h"

namespace hysteron {
namespace {

// The triangles at each edge, by its vertices in ascending order.
using Edges = std::map<std::pair<int, int>, std::vector<std::size_t>>;

std::pair<int, int> edge_at(const Eigen::Vector3i& face, int corner) {
  return std::minmax({face[corner], face[(corner + 1) % 3]});
}

// A triangle's texture as a linear map of its plane, whose first axis is an edge from `origin`.
class TextureMap {
 public:
  // Takes the triangle `face`, along the edge from its corner `corner` to the next one.
  TextureMap(const ObjSoup& soup, std::size_t face, int corner) {
    const int next = (corner + 1) % 3, last = (corner + 2) % 3;
    const auto at = [&](int i) { return soup.vertex[soup.face[face][i]]; };
    const auto uv = [&](int i) { return *soup.uv[face][i]; };
    origin_ = at(corner);
    axis_ = (at(next) - origin_).normalized();
    texture_ = uv(corner);
    edge_ = (uv(next) - texture_).norm();
    along_ = (uv(next) - texture_) / (at(next) - origin_).norm();
    across_ = (uv(last) - texture_ - along(at(last)) * along_) / distance(at(last));
  }

  // Returns the edge's length in the texture.
  double edge() const { return edge_; }
  // Returns the texture of a point on the other side of the edge, as if its triangle were turned into this
  // one's plane.
  Eigen::Vector2d beyond(const Eigen::Vector3d& x) const {
    return texture_ + along(x) * along_ - distance(x) * across_;
  }

 private:
  double along(const Eigen::Vector3d& x) const { return (x - origin_).dot(axis_); }
  double distance(const Eigen::Vector3d& x) const { return (x - origin_ - along(x) * axis_).norm(); }

  Eigen::Vector3d origin_, axis_;
  Eigen::Vector2d texture_, along_, across_;  // of the origin; per metre along the edge, and across it
  double edge_ = 0;
};

// The coordinates that vertices have got.
using Computed = std::map<int, Eigen::Vector2d>;

// Returns the vertex's coordinates from another neighbour, where they are the same but for rounding: around a
// tube they are not.
Eigen::Vector2d without_rounding(const Eigen::Vector2d& uv, int vertex, const TextureMap& map,
                                 Computed& computed) {
  constexpr double kRounding = 1e-6;  // over the neighbour's edge; OBJs are written with six digits and more
  const auto [known, is_new] = computed.try_emplace(vertex, uv);
  return (known->second - uv).norm() <= kRounding * map.edge() ? known->second : uv;
}

// Returns false where the neighbour's area is zero.
bool continue_from(std::size_t from, int corner, std::size_t face, ObjSoup& soup, Computed& computed) {
  const TextureMap map(soup, from, corner);
  std::array<Uv, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const int v = soup.face[face][i];
    for (int j = 0; j < 3; ++j)
      if (j != (corner + 2) % 3 && soup.face[from][j] == v) corners[i] = soup.uv[from][j];
    if (corners[i]) continue;
    const Eigen::Vector2d uv = map.beyond(soup.vertex[v]);
    if (!uv.allFinite()) return false;
    corners[i] = soup.uv[face][i] ? soup.uv[face][i] : without_rounding(uv, v, map, computed);
  }
  soup.uv[face] = corners;
  return true;
}

}  // namespace

void share_texture(ObjSoup& soup) {
  struct OfVertex {
    Uv only;
    bool several = false;
  };
  std::vector<OfVertex> known(soup.vertex.size());
  const auto for_each_corner = [&](const auto& visit) {
    for (std::size_t f = 0; f < soup.face.size(); ++f)
      for (int i = 0; i < 3; ++i) visit(known[soup.face[f][i]], soup.uv[f][i]);
  };
  for_each_corner([](OfVertex& vertex, const Uv& uv) {
    vertex.several = vertex.several || (uv && vertex.only && *uv != *vertex.only);
    if (uv) vertex.only = uv;
  });
  for_each_corner([](const OfVertex& vertex, Uv& uv) {
    if (!uv && !vertex.several) uv = vertex.only;
  });
}

std::vector<int> continue_texture(ObjSoup& soup) {
  std::vector<int> lines;
  std::deque<std::size_t> whole;
  for (std::size_t f = 0; f < soup.face.size(); ++f)
    if (is_whole(soup.uv[f])) whole.push_back(f);
  if (whole.size() == soup.face.size()) return lines;
  Edges edges;
  Computed computed;
  for (std::size_t f = 0; f < soup.face.size(); ++f)
    for (int i = 0; i < 3; ++i) edges[edge_at(soup.face[f], i)].push_back(f);
  for (; !whole.empty(); whole.pop_front()) {
    const std::size_t from = whole.front();
    for (int i = 0; i < 3; ++i)
      for (const std::size_t face : edges[edge_at(soup.face[from], i)]) {
        if (is_whole(soup.uv[face]) || !continue_from(from, i, face, soup, computed)) continue;
        lines.push_back(soup.face_line[face]);
        whole.push_back(face);
      }
  }
  return lines;
}

}  // namespace hysteron
