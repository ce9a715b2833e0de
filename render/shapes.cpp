#include "render/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/rotation.h"

namespace hysteron::render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

void require_positive(const char* what, float length) {
  if (!(length > 0) || !std::isfinite(length))
    throw Error::invalid_input(std::string(what) + " = " + std::to_string(length) + " m must be > 0");
}

// A point of an outline in the (distance from the axis, z) half plane, with its outward normal.
struct OutlinePoint {
  float distance, z;
  float normal_distance, normal_z;
};

void add_line(std::vector<OutlinePoint>& outline, Eigen::Vector2f from, Eigen::Vector2f to, int bands) {
  const Eigen::Vector2f along = (to - from).normalized();
  for (int i = 0; i <= bands; ++i) {
    const Eigen::Vector2f p = from + (to - from) * (static_cast<float>(i) / bands);
    outline.push_back({p.x(), p.y(), -along.y(), along.x()});
  }
}

// Adds an arc about `center` from elevation `from` to `to` [rad].
void add_arc(std::vector<OutlinePoint>& outline, Eigen::Vector2f center, float radius, float from, float to,
             int bands) {
  for (int i = 0; i <= bands; ++i) {
    const float angle = from + (to - from) * static_cast<float>(i) / bands;
    const float c = std::cos(angle), s = std::sin(angle);
    outline.push_back({center.x() + radius * c, center.y() + radius * s, c, s});
  }
}

void add_quads(TriangleMesh& mesh, std::uint32_t first, int rows, int columns) {
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j + 1 < columns; ++j) {
      const std::uint32_t a = first + i * columns + j, b = a + columns;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
}

// Turns an outline from the top of the axis to its bottom about z.
TriangleMesh turned(const std::vector<OutlinePoint>& outline, float roundness, int sectors) {
  TriangleMesh mesh;
  mesh.roundness = roundness;
  mesh.centred = true;
  for (const OutlinePoint& point : outline)
    for (int j = 0; j <= sectors; ++j) {
      const float angle = 2 * kPi * static_cast<float>(j % sectors) / static_cast<float>(sectors);
      const float c = std::cos(angle), s = std::sin(angle);
      mesh.positions.emplace_back(point.distance * c, point.distance * s, point.z);
      mesh.normals.emplace_back(point.normal_distance * c, point.normal_distance * s, point.normal_z);
    }
  add_quads(mesh, 0, static_cast<int>(outline.size()), sectors + 1);
  return mesh;
}

// Adds one face of the rounded box: a grid on the cube's face, pushed from the inner box outward by the rim.
void add_box_face(TriangleMesh& mesh, const Eigen::Vector3f& half, float rim, const ShapeDetail& detail,
                  int axis, float sign) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int rim_bands = detail.rim_bands, side = detail.bands + 2 * rim_bands + 1;
  const auto place = [&](int i, float half_edge) {
    const float inner = half_edge - rim;
    const auto bent = [&](int k) {
      return rim * std::tan(kPi / 4 * (1 - static_cast<float>(k) / rim_bands));
    };
    if (i <= rim_bands) return -inner - bent(i);
    if (i >= side - 1 - rim_bands) return inner + bent(side - 1 - i);
    return -inner + 2 * inner * static_cast<float>(i - rim_bands) / static_cast<float>(detail.bands);
  };
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      Eigen::Vector3f point;
      point[axis] = sign * half[axis];
      point[u] = place(sign > 0 ? i : side - 1 - i, half[u]);
      point[v] = place(j, half[v]);
      const Eigen::Vector3f reach = half.array() - rim;
      const Eigen::Vector3f inner = point.cwiseMax(-reach).cwiseMin(reach);
      const Eigen::Vector3f normal = (point - inner).normalized();
      mesh.positions.push_back(inner + rim * normal);
      mesh.normals.push_back(normal);
    }
  add_quads(mesh, first, side, side);
}

}  // namespace

TriangleMesh sphere_mesh(float radius, const ShapeDetail& detail) {
  require_positive("sphere radius", radius);
  std::vector<OutlinePoint> outline;
  add_arc(outline, {0, 0}, radius, kPi / 2, -kPi / 2, detail.sectors / 2);
  return turned(outline, radius, detail.sectors);
}

TriangleMesh cylinder_mesh(float radius, float height, float rim, const ShapeDetail& detail) {
  require_positive("cylinder radius", radius);
  require_positive("cylinder height", height);
  const float round = std::clamp(rim, 1e-4f * radius, std::min(radius, height / 2));
  const float inner = radius - round, half = height / 2;
  std::vector<OutlinePoint> outline;
  add_line(outline, {0, half}, {inner, half}, detail.bands);
  add_arc(outline, {inner, half - round}, round, kPi / 2, 0, detail.rim_bands);
  add_line(outline, {radius, half - round}, {radius, round - half}, detail.bands);
  add_arc(outline, {inner, round - half}, round, 0, -kPi / 2, detail.rim_bands);
  add_line(outline, {inner, -half}, {0, -half}, detail.bands);
  return turned(outline, round, detail.sectors);
}

TriangleMesh capsule_mesh(float radius, float height, const ShapeDetail& detail) {
  require_positive("capsule radius", radius);
  require_positive("capsule height", height);
  std::vector<OutlinePoint> outline;
  add_arc(outline, {0, height / 2}, radius, kPi / 2, 0, detail.sectors / 4);
  add_line(outline, {radius, height / 2}, {radius, -height / 2}, detail.bands);
  add_arc(outline, {0, -height / 2}, radius, 0, -kPi / 2, detail.sectors / 4);
  return turned(outline, radius, detail.sectors);
}

TriangleMesh torus_mesh(float radius, float height, const ShapeDetail& detail) {
  require_positive("torus radius", radius);
  require_positive("torus height", height);
  std::vector<OutlinePoint> outline;
  add_arc(outline, {radius, 0}, height / 2, kPi, -kPi, detail.sectors / 2);
  TriangleMesh mesh = turned(outline, height / 2, detail.sectors);
  mesh.centred = false;
  return mesh;
}

TriangleMesh box_mesh(const Eigen::Vector3f& half_edges, float rim, const ShapeDetail& detail) {
  for (int axis = 0; axis < 3; ++axis) require_positive("box half edge", half_edges[axis]);
  const float least = half_edges.minCoeff();
  const float round = std::clamp(rim, 1e-3f * least, least);
  TriangleMesh mesh;
  mesh.roundness = round;
  mesh.centred = true;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) add_box_face(mesh, half_edges, round, detail, axis, sign);
  return mesh;
}

TriangleMesh smooth_mesh(std::span<const Eigen::Vector3d> position, std::span<const Eigen::Vector3i> face) {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> normal(position.size(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3i& f : face) {
    const Eigen::Vector3d& a = position[f[0]];
    const Eigen::Vector3d twice_area = (position[f[1]] - a).cross(position[f[2]] - a);
    for (const int v : f) {
      normal[v] += twice_area;
      mesh.triangles.push_back(static_cast<std::uint32_t>(v));
    }
  }
  for (std::size_t v = 0; v < normal.size(); ++v) {
    mesh.positions.push_back(position[v].cast<float>());
    mesh.normals.push_back(normal[v].normalized().cast<float>());
  }
  return mesh;
}

Eigen::Matrix4f placed(const Eigen::Vector3f& center, const Eigen::Vector3f& axis) {
  Eigen::Matrix4f transform = Eigen::Matrix4f::Identity();
  transform.topLeftCorner<3, 3>() = rotation_between(Eigen::Vector3f::UnitZ(), axis.normalized());
  transform.topRightCorner<3, 1>() = center;
  return transform;
}

namespace {

using Index = std::uint32_t;

// Halves the sides that are too long, each once.
class Halving {
 public:
  Halving(TriangleMesh& mesh, float longest) : mesh_(mesh), longest_(longest) {}

  // Returns the vertex halfway from a to b, or a where the side is short enough.
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

// Splits the triangle (a, b, c) at the middles of its sides ab, bc, ca; a middle equal to the side's first
// vertex stands for none.
void split(std::vector<Index>& triangles, std::array<Index, 3> corner, std::array<Index, 3> middle) {
  const auto halved = [&](int k) { return middle[k] != corner[k]; };
  const int count = halved(0) + halved(1) + halved(2);
  // The corners turn until side ab is halved and, of two halved sides, ca is none.
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
    throw Error::invalid_input("refining a mesh: longest side = " + std::to_string(longest) +
                               " m must be > 0");
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
