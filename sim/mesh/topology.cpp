#include "sim/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/base/error.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/mesh/point_grid.h"

namespace hysteron {

namespace {

// A triangle below this height over longest edge has no usable normal: its hinge angles would be rounding
// noise of the vertices.
constexpr double kMinHeightRatio = 1e-6;

// One directed side of a triangle, opposite to its corner; lo and hi are its vertices in rising order.
struct Side {
  int lo, hi;
  int corner;  // 3 * face + corner
};

int side_from(const ClothMesh& mesh, int corner) { return mesh.face[corner / 3][(corner % 3 + 1) % 3]; }
int side_to(const ClothMesh& mesh, int corner) { return mesh.face[corner / 3][(corner % 3 + 2) % 3]; }
int tip(const ClothMesh& mesh, int corner) { return mesh.face[corner / 3][corner % 3]; }

void check_indices(const ClothMesh& mesh, const MeshNames& names) {
  if (mesh.face.empty())
    throw Error::invalid_input(names.what + ": no triangles; a cloth needs at least one");
  for (int f = 0; f < mesh.faces(); ++f) {
    for (const int v : mesh.face[f]) {
      if (v >= 0 && v < mesh.vertices()) continue;
      throw Error::invalid_input(names.what + ": " + names.triangle(f) + " uses vertex " + std::to_string(v) +
                                 ", allowed are 0 to " + std::to_string(mesh.vertices() - 1));
    }
  }
}

void check_vertices(const ClothMesh& mesh, const MeshNames& names) {
  std::vector<char> used(mesh.rest.size(), 0);
  for (const auto& face : mesh.face)
    for (const int v : face) used[v] = 1;
  for (int v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.rest[v].allFinite())
      throw Error::invalid_input(names.what + ": " + names.vertex(v) + " is not a finite number");
    if (!used[v])
      throw Error::invalid_input(names.what + ": " + names.vertex(v) + " belongs to no triangle; remove it");
  }
  if (!mesh.pattern.empty() && mesh.pattern.size() != mesh.rest.size())
    throw Error::invalid_input(names.what + ": " + std::to_string(mesh.pattern.size()) +
                               " pattern coordinates for " + std::to_string(mesh.vertices()) +
                               " vertices; give one each or none");
  if ((mesh.sewn || !mesh.panel.empty()) && mesh.panel.size() != mesh.face.size())
    throw Error::invalid_input(names.what + ": " + std::to_string(mesh.panel.size()) + " panels for " +
                               std::to_string(mesh.faces()) + " triangles; give one each or none");
}

using Corners = std::array<Eigen::Vector3d, 3>;

Eigen::Vector3d area_vector(const Corners& at) { return 0.5 * (at[1] - at[0]).cross(at[2] - at[0]); }

double longest_side(const Corners& at) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, (at[i] - at[(i + 1) % 3]).norm());
  return longest;
}

// Returns all sides, those of one edge next to each other, the lower triangle first.
std::vector<Side> sorted_sides(const ClothMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.face.size());
  for (int corner = 0; corner < 3 * mesh.faces(); ++corner) {
    const auto [lo, hi] = std::minmax({side_from(mesh, corner), side_to(mesh, corner)});
    sides.push_back({lo, hi, corner});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.lo, a.hi, a.corner) < std::tie(b.lo, b.hi, b.corner);
  });
  return sides;
}

std::string edge_name(const MeshNames& names, const Side& side) {
  return "the edge between " + names.vertex(side.lo) + " and " + names.vertex(side.hi);
}

void check_pair(const ClothMesh& mesh, const MeshNames& names, const Side& a, const Side& b) {
  const std::string pair = names.triangle(a.corner / 3) + " and " + names.triangle(b.corner / 3);
  if (tip(mesh, a.corner) == tip(mesh, b.corner))
    throw Error::invalid_input(names.what + ": " + pair + " have the same vertices; remove one");
  if (side_from(mesh, a.corner) == side_from(mesh, b.corner))
    throw Error::invalid_input(names.what + ": " + pair + " have opposite orientation at " +
                               edge_name(names, a) + "; turn one over (a Moebius strip has no front)");
}

// Lists interior edges first, each kind in the order of its first triangle, which keeps neighbours near in
// memory.
void connect_edges(ClothMesh& mesh, const MeshNames& names) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<std::array<int, 2>> interior, boundary;  // corners of the one or two sides
  for (std::size_t i = 0, next; i < sides.size(); i = next) {
    for (next = i; next < sides.size() && sides[next].lo == sides[i].lo && sides[next].hi == sides[i].hi;)
      ++next;
    if (next - i > 2)
      throw Error::invalid_input(names.what + ": " + edge_name(names, sides[i]) + " is shared by " +
                                 std::to_string(next - i) + " triangles (the third is " +
                                 names.triangle(sides[i + 2].corner / 3) + "), allowed are 2");
    if (next - i == 2) check_pair(mesh, names, sides[i], sides[i + 1]);
    if (next - i == 2)
      interior.push_back({sides[i].corner, sides[i + 1].corner});
    else
      boundary.push_back({sides[i].corner, -1});
  }
  std::sort(interior.begin(), interior.end());
  std::sort(boundary.begin(), boundary.end());
  mesh.interior_edges = static_cast<int>(interior.size());
  interior.insert(interior.end(), boundary.begin(), boundary.end());

  mesh.edge.clear();
  mesh.face_edge.resize(mesh.face.size());
  for (const auto& [first, second] : interior) {
    const int e = static_cast<int>(mesh.edge.size());
    const bool inner = second >= 0;
    mesh.edge.push_back({tip(mesh, first), inner ? tip(mesh, second) : -1, side_from(mesh, first),
                         side_to(mesh, first), first / 3, inner ? second / 3 : -1});
    mesh.face_edge[first / 3][first % 3] = e;
    if (inner) mesh.face_edge[second / 3][second % 3] = e;
  }
}

// Returns the derivative of the position by the first texture coordinate over a triangle; zero where these
// coordinates are degenerate.
Eigen::Vector3d texture_warp(const Corners& at, const std::array<Eigen::Vector2d, 3>& texture) {
  const Eigen::Vector2d u = texture[1] - texture[0], v = texture[2] - texture[0];
  const double det = u.x() * v.y() - u.y() * v.x();
  if (std::abs(det) <= kMinHeightRatio * std::max(u.squaredNorm(), v.squaredNorm()))
    return Eigen::Vector3d::Zero();
  const Eigen::Vector3d x1 = at[1] - at[0], x2 = at[2] - at[0];
  return (x1 * v.y() - x2 * u.y()) / det;
}

void gather_vertex_faces(ClothMesh& mesh) {
  Adjacency& rows = mesh.vertex_faces;
  rows.start.assign(mesh.rest.size() + 1, 0);
  rows.item.resize(3 * mesh.face.size());
  for (const auto& face : mesh.face)
    for (const int v : face) ++rows.start[v + 1];
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) rows.start[v + 1] += rows.start[v];
  std::vector<int> end(rows.start.begin(), rows.start.end() - 1);
  for (int corner = 0; corner < 3 * mesh.faces(); ++corner) rows.item[end[tip(mesh, corner)]++] = corner;
}

}  // namespace

std::string MeshNames::triangle(int f) const {
  return face_line.empty() ? "triangle " + std::to_string(f)
                           : "the triangle of line " + std::to_string(face_line[f]);
}

std::string MeshNames::vertex(int v) const {
  return vertex_line.empty() ? "vertex " + std::to_string(v)
                             : "the vertex of line " + std::to_string(vertex_line[v]);
}

void measure_areas(ClothMesh& mesh, const MeshNames& names) {
  mesh.face_area.resize(mesh.face.size());
  mesh.vertex_area.assign(mesh.rest.size(), 0.0);
  for (int f = 0; f < mesh.faces(); ++f) {
    const Corners at = mesh.corners(f);
    const double area = area_vector(at).norm(), side = longest_side(at);
    if (!(2 * area >= kMinHeightRatio * side * side) || side == 0)
      throw Error::invalid_input(names.what + ": " + names.triangle(f) + " is degenerate (" +
                                 names.vertex(mesh.face[f][0]) + ", " + names.vertex(mesh.face[f][1]) + ", " +
                                 names.vertex(mesh.face[f][2]) +
                                 "): height over longest edge must be >= 1e-6");
    mesh.face_area[f] = area;
    for (const int v : mesh.face[f]) mesh.vertex_area[v] += area / 3;
  }
}

void build_topology(ClothMesh& mesh, const MeshNames& names) {
  check_indices(mesh, names);
  check_vertices(mesh, names);
  measure_areas(mesh, names);
  connect_edges(mesh, names);
  gather_vertex_faces(mesh);
}

void build_topology(ClothMesh& mesh, const std::string& what) {
  build_topology(mesh, MeshNames{what, {}, {}});
}

std::array<Eigen::Vector3d, 3> ClothMesh::corners(int f) const {
  if (!sewn) return {rest[face[f][0]], rest[face[f][1]], rest[face[f][2]]};
  const auto at = [&](int k) { return Eigen::Vector3d(panel[f][k].x(), panel[f][k].y(), 0); };
  return {at(0), at(1), at(2)};
}

FaceSide ClothMesh::side(int f, int e) const {
  const auto& edges = face_edge[f];
  const int k = static_cast<int>(std::find(edges.begin(), edges.end(), e) - edges.begin());
  const Corners at = corners(f);
  return {at[k], at[(k + 1) % 3], at[(k + 2) % 3]};
}

double ClothMesh::edge_length(int e) const {
  const auto in_face = [&](int f) {
    const FaceSide at = side(f, e);
    return (at.to - at.from).norm();
  };
  const double first = in_face(edge[e].face0);
  return sewn && edge[e].interior() ? (first + in_face(edge[e].face1)) / 2 : first;
}

double ClothMesh::mean_edge_length() const {
  double sum = 0;
  for (std::size_t e = 0; e < edge.size(); ++e) sum += edge_length(static_cast<int>(e));
  return sum / static_cast<double>(edge.size());
}

double ClothMesh::mean_edge_in_space() const {
  double sum = 0;
  for (const Edge& e : edge) sum += (rest[e.p3] - rest[e.p2]).norm();
  return sum / static_cast<double>(edge.size());
}

std::array<Eigen::Vector3d, 2> ClothMesh::face_axes(int f) const {
  const Corners at = corners(f);
  const Eigen::Vector3d normal = area_vector(at).normalized();
  Eigen::Vector3d warp = Eigen::Vector3d::Zero();
  if (!panel.empty())
    warp = texture_warp(at, panel[f]);
  else if (!pattern.empty())
    warp = texture_warp(at, {pattern[face[f][0]], pattern[face[f][1]], pattern[face[f][2]]});
  const bool textured = !warp.isZero(0);
  if (!textured) warp = warp_axis;
  Eigen::Vector3d in_plane = warp - normal * normal.dot(warp);
  // A warp direction that pierces the triangle does not define one in it; any fixed choice serves.
  if (in_plane.norm() <= kMinHeightRatio * warp.norm()) in_plane = at[1] - at[0];
  in_plane.normalize();
  if (textured) in_plane = warp_axis.x() * in_plane + warp_axis.y() * normal.cross(in_plane);
  return {in_plane, normal.cross(in_plane)};
}

std::vector<int> nearby_representatives(const std::vector<Eigen::Vector3d>& points, double distance) {
  PointGrid kept(points, distance);
  std::vector<int> representative;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    int lowest = i;
    kept.around(points[i], [&](int j) {
      if (j < lowest && (points[j] - points[i]).norm() < distance) lowest = j;
    });
    representative.push_back(lowest);
    if (lowest == i) kept.add(i, points[i]);
  }
  return representative;
}

ClothMesh copied_mesh(const ClothMesh& mesh, int copies, const Eigen::Vector3d& offset) {
  ClothMesh all;
  all.warp_axis = mesh.warp_axis;
  all.sewn = mesh.sewn;
  for (int k = 0; k < copies; ++k) {
    for (const Eigen::Vector3d& x : mesh.rest) all.rest.push_back(x + k * offset);
    for (const Eigen::Vector3i& t : mesh.face) all.face.push_back(t.array() + k * mesh.vertices());
    all.pattern.insert(all.pattern.end(), mesh.pattern.begin(), mesh.pattern.end());
    all.panel.insert(all.panel.end(), mesh.panel.begin(), mesh.panel.end());
  }
  build_topology(all, "copies of the mesh");
  return all;
}

}  // namespace hysteron
