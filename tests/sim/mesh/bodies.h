// Bodies of triangles for tests, and their files.
#pragma once

#include <Eigen/Core>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace hysteron::test {

// The triangles face outward.
struct Body {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<Eigen::Vector3i> face;

  Body moved(const Eigen::Vector3d& by) const {
    Body body = *this;
    for (Eigen::Vector3d& x : body.vertex) x += by;
    return body;
  }
  Body scaled(double by) const {
    Body body = *this;
    for (Eigen::Vector3d& x : body.vertex) x *= by;
    return body;
  }
  Body inside_out() const {
    Body body = *this;
    for (Eigen::Vector3i& f : body.face) std::swap(f[1], f[2]);
    return body;
  }
};

// The tetrahedron has a corner in the origin and sides of 1 along the axes.
inline Body tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// An octahedron whose triangles are cut into four that often; its vertices lie on the sphere.
inline Body ball(double radius, int subdivisions) {
  Body body{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int i = 0; i < subdivisions; ++i) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [place, is_new] =
          middle.try_emplace(std::minmax(a, b), static_cast<int>(body.vertex.size()));
      if (is_new) body.vertex.push_back((body.vertex[a] + body.vertex[b]).normalized());
      return place->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : body.face) {
      const int a = between(f[0], f[1]), b = between(f[1], f[2]), c = between(f[2], f[0]);
      for (const Eigen::Vector3i& part : {Eigen::Vector3i(f[0], a, c), Eigen::Vector3i(a, f[1], b),
                                          Eigen::Vector3i(c, b, f[2]), Eigen::Vector3i(a, b, c)})
        finer.push_back(part);
    }
    body.face = finer;
  }
  return body.scaled(radius);
}

inline std::string obj_text(const Body& body) {
  std::ostringstream text;
  text.precision(17);
  for (const Eigen::Vector3d& x : body.vertex) text << "v " << x.transpose() << "\n";
  for (const Eigen::Vector3i& f : body.face) text << "f " << (f.array() + 1).transpose() << "\n";
  return text.str();
}

inline std::string ply_text(const Body& body) {
  std::ostringstream text;
  text.precision(17);
  text << "ply\nformat ascii 1.0\nelement vertex " << body.vertex.size()
       << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << body.face.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& x : body.vertex) text << x.transpose() << "\n";
  for (const Eigen::Vector3i& f : body.face) text << "3 " << f.transpose() << "\n";
  return text.str();
}

}  // namespace hysteron::test
