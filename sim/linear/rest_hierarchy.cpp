// Coarse nodes are a maximal set of vertices no two of which are within two edges of each other; every vertex
// belongs to the cell of the nearest one.  Coarse nodes whose cells touch are neighbours, as in the Delaunay
// triangulation that is dual to the cells, and each vertex is interpolated from a triangle of such
// neighbours.
#include "sim/linear/rest_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "sim/linear/compressed_rows.h"

namespace hysteron {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kCoarsestNodes = 24;  // on a CPU a dense inverse of more takes longer than another level
// A level that keeps more than this share of the nodes is not worth its cost (cloth in many small pieces).
constexpr double kAcceptableFill = 0.5;
// Edges longer than this many times the shortest one at either end do not keep roots apart: a mesh of slender
// triangles is coarsened along its short edges first, which couple most.
constexpr double kLongEdge = 2.5;
constexpr double kInside = 1e-9;  // weights above minus this count as inside
// Boundaries that turn by more keep their corner among the coarse nodes.
constexpr double kCornerCosine = 0.9;

// The nodes of one level on the rest shape.
struct Surface {
  std::vector<Vector3d> position, normal;
  std::vector<int> rank;  // 2: corners, 1: boundary, 0: inside; chosen in this order to keep the outline
  Adjacency neighbour;
  int size() const { return static_cast<int>(position.size()); }
};

void insert_once(std::vector<int>& row, int item) {
  if (std::find(row.begin(), row.end(), item) == row.end()) row.push_back(item);
}

std::vector<int> boundary_ranks(const ClothMesh& mesh) {
  std::vector<int> rank(mesh.vertices(), 0);
  std::vector<Vector3d> first(mesh.vertices(), Vector3d::Zero());
  for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e) {
    const int a = mesh.edge[e].p2, b = mesh.edge[e].p3;
    const Vector3d direction = (mesh.rest[b] - mesh.rest[a]).normalized();
    for (int v : {a, b}) {
      if (rank[v] == 0)
        first[v] = direction;
      else if (std::abs(first[v].dot(direction)) < kCornerCosine)
        rank[v] = 2;
      rank[v] = std::max(rank[v], 1);
    }
  }
  return rank;
}

Surface mesh_surface(const ClothMesh& mesh) {
  Surface s;
  s.position = mesh.rest;
  s.normal.assign(mesh.vertices(), Vector3d::Zero());
  for (const auto& f : mesh.face) {
    const Vector3d n = (mesh.rest[f[1]] - mesh.rest[f[0]]).cross(mesh.rest[f[2]] - mesh.rest[f[0]]);
    for (int k = 0; k < 3; ++k) s.normal[f[k]] += n;
  }
  s.neighbour = neighbours_in(mesh);
  s.rank = boundary_ranks(mesh);
  return s;
}

double distance(const Surface& s, int i, int j) { return (s.position[i] - s.position[j]).norm(); }

// Returns the neighbours joined by edges that are not long.
Adjacency close_neighbours(const Surface& s) {
  const auto& [start, item] = s.neighbour;
  std::vector<double> shortest(s.size(), std::numeric_limits<double>::infinity());
  for (int i = 0; i < s.size(); ++i)
    for (int j = start[i]; j < start[i + 1]; ++j)
      shortest[i] = std::min(shortest[i], distance(s, i, item[j]));
  Adjacency close;
  close.start.push_back(0);
  for (int i = 0; i < s.size(); ++i) {
    for (int j = start[i]; j < start[i + 1]; ++j)
      if (distance(s, i, item[j]) <= kLongEdge * std::max(shortest[i], shortest[item[j]]))
        close.item.push_back(item[j]);
    close.start.push_back(static_cast<int>(close.item.size()));
  }
  return close;
}

// Returns 1 for chosen nodes.
std::vector<char> choose_roots(const Surface& s) {
  std::vector<char> root(s.size(), 0), near(s.size(), 0);  // near: within one edge of a root
  const Adjacency close = close_neighbours(s);
  const std::vector<int>&start = close.start, &item = close.item;
  const auto is_free = [&](int i) {
    bool is = !near[i];
    for (int j = start[i]; is && j < start[i + 1]; ++j) is = !near[item[j]];
    return is;
  };
  for (int rank = 2; rank >= 0; --rank)
    for (int i = 0; i < s.size(); ++i) {
      if (s.rank[i] != rank || !is_free(i)) continue;
      root[i] = near[i] = 1;
      for (int j = start[i]; j < start[i + 1]; ++j) near[item[j]] = 1;
    }
  return root;
}

// Returns for each node the nearest root along edges, as that root's number among the roots.
std::vector<int> cells(const Surface& s, const std::vector<char>& root) {
  using Entry = std::pair<double, int>;  // distance, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  std::vector<double> nearest(s.size(), std::numeric_limits<double>::infinity());
  std::vector<int> cell(s.size(), -1);
  int count = 0;
  for (int i = 0; i < s.size(); ++i)
    if (root[i]) {
      cell[i] = count++;
      nearest[i] = 0;
      front.push({0.0, i});
    }
  while (!front.empty()) {
    const auto [d, i] = front.top();
    front.pop();
    if (d > nearest[i]) continue;
    for (int j = s.neighbour.start[i]; j < s.neighbour.start[i + 1]; ++j) {
      const int to = s.neighbour.item[j];
      const double beyond = d + distance(s, i, to);
      if (beyond >= nearest[to]) continue;
      nearest[to] = beyond;
      cell[to] = cell[i];
      front.push({beyond, to});
    }
  }
  return cell;
}

Surface coarser(const Surface& s, const std::vector<char>& root, const std::vector<int>& cell) {
  Surface c;
  for (int i = 0; i < s.size(); ++i)
    if (root[i]) {
      c.position.push_back(s.position[i]);
      c.normal.push_back(s.normal[i]);
      c.rank.push_back(s.rank[i]);
    }
  std::vector<std::vector<int>> neighbours(c.size());
  for (int i = 0; i < s.size(); ++i)
    for (int j = s.neighbour.start[i]; j < s.neighbour.start[i + 1]; ++j) {
      const int a = cell[i], b = cell[s.neighbour.item[j]];
      if (a != b) insert_once(neighbours[a], b);
    }
  c.neighbour = compressed(neighbours);
  return c;
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Finds the triangle of three points that contains the origin and has the smallest circumscribed circle;
// false if there is none.
bool containing_triangle(const std::vector<Vector2d>& p, std::array<int, 3>& corner,
                         std::array<double, 3>& weight) {
  double smallest = std::numeric_limits<double>::infinity();
  const int n = static_cast<int>(p.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        const double area = cross(p[j] - p[i], p[k] - p[i]);
        const double wi = cross(p[j], p[k]) / area, wj = cross(p[k], p[i]) / area, wk = 1 - wi - wj;
        if (!(wi > -kInside && wj > -kInside && wk > -kInside)) continue;  // nor is a triangle without area
        const double radius =
            (p[i] - p[j]).norm() * (p[j] - p[k]).norm() * (p[k] - p[i]).norm() / std::abs(area);
        if (radius >= smallest) continue;
        smallest = radius;
        corner = {i, j, k};
        weight = {wi, wj, wk};
      }
  return smallest < std::numeric_limits<double>::infinity();
}

// Outside all triangles, finds the nearest point of the segments between the points, preferring short ones.
void nearest_segment(const std::vector<Vector2d>& p, std::array<int, 3>& corner,
                     std::array<double, 3>& weight) {
  constexpr double kLength = 0.01;  // weight of a segment's length against the distance from it
  corner = {0, 0, 0};
  weight = {1, 0, 0};
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(p.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(p.size()); ++j) {
      const Vector2d d = p[j] - p[i];
      const double t = std::clamp(-p[i].dot(d) / d.squaredNorm(), 0.0, 1.0);
      const double cost = (p[i] + t * d).norm() + kLength * d.norm();
      if (!(cost < best)) continue;
      best = cost;
      corner = {i, j, j};
      weight = {1 - t, t, 0};
    }
}

// Returns the nodes and their neighbours, each once.
std::vector<int> with_neighbours(std::vector<int> nodes, const Adjacency& neighbour) {
  for (int i : std::vector<int>(nodes))
    for (int j = neighbour.start[i]; j < neighbour.start[i + 1]; ++j) insert_once(nodes, neighbour.item[j]);
  return nodes;
}

// Returns positions relative to node i of the surface, in its tangent plane.
std::vector<Vector2d> flattened(const Surface& s, int i, const std::vector<Vector3d>& position,
                                const std::vector<int>& nodes) {
  const Vector3d normal = s.normal[i].normalized(), t1 = normal.unitOrthogonal(), t2 = normal.cross(t1);
  std::vector<Vector2d> flat;
  for (int c : nodes) {
    const Vector3d d = position[c] - s.position[i];
    flat.push_back({d.dot(t1), d.dot(t2)});
  }
  return flat;
}

Interpolation interpolate(const Surface& s, int i, int cell, const Surface& coarse) {
  constexpr int kRings = 2;  // near the boundary the triangle may be beyond the first ring
  std::vector<int> near{cell};
  std::vector<Vector2d> flat;
  std::array<int, 3> corner;
  std::array<double, 3> weight;
  bool inside = false;
  for (int ring = 0; ring < kRings && !inside; ++ring) {
    near = with_neighbours(near, coarse.neighbour);
    flat = flattened(s, i, coarse.position, near);
    inside = containing_triangle(flat, corner, weight);
  }
  if (!inside) nearest_segment(flat, corner, weight);
  Interpolation result;
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += weight[k] = std::max(weight[k], 0.0);
  for (int k = 0; k < 3; ++k) {
    result.node[k] = near[corner[k]];
    result.weight[k] = weight[k] / sum;
  }
  return result;
}

std::vector<Interpolation> interpolations(const Surface& s, const std::vector<char>& root,
                                          const std::vector<int>& cell, const Surface& coarse) {
  std::vector<Interpolation> result(s.size());
#pragma omp parallel for schedule(static)
  for (int i = 0; i < s.size(); ++i)
    result[i] =
        root[i] ? Interpolation{{cell[i], cell[i], cell[i]}, {1, 0, 0}} : interpolate(s, i, cell[i], coarse);
  return result;
}

// Couples all coarse nodes that interpolate two finer nodes.
void couple(const Interpolation& a, const Interpolation& b, std::vector<std::vector<int>>& rows) {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      if (a.weight[k] == 0 || b.weight[l] == 0 || a.node[k] == b.node[l]) continue;
      insert_once(rows[a.node[k]], b.node[l]);
      insert_once(rows[b.node[l]], a.node[k]);
    }
}

// Returns the couplings of coarse nodes that follow from the finer nodes' matrix.
std::vector<std::vector<int>> coarse_rows(const Adjacency& fine, const RestLevel& level) {
  std::vector<std::vector<int>> rows(level.nodes);
  for (std::size_t i = 0; i + 1 < fine.start.size(); ++i) {
    couple(level.finer[i], level.finer[i], rows);
    for (int j = fine.start[i]; j < fine.start[i + 1]; ++j)
      couple(level.finer[i], level.finer[fine.item[j]], rows);
  }
  return rows;
}

// Adds for the first level the couplings by the plate's hinges.
void couple_hinges(const ClothMesh& mesh, const RestLevel& level, std::vector<std::vector<int>>& rows) {
  for (const Edge& e : mesh.edge) {
    const int corner[4] = {e.p2, e.p3, e.p0, e.interior() ? e.p1 : e.p0};
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < k; ++l) couple(level.finer[corner[k]], level.finer[corner[l]], rows);
  }
}

struct Coefficient {
  int node;
  double value;
};

// Returns the rate of a flat hinge's angle by the heights of its vertices, in terms of the coarse nodes.
std::vector<Coefficient> coarse_gradient(const ClothMesh& mesh, const Edge& e, const std::vector<char>& held,
                                         const RestLevel& level) {
  const Vector3d along = mesh.rest[e.p3] - mesh.rest[e.p2];
  const double length = along.norm();
  const double h0 = 2 * mesh.face_area[e.face0] / length, h1 = 2 * mesh.face_area[e.face1] / length;
  const double t0 = (mesh.rest[e.p0] - mesh.rest[e.p2]).dot(along) / (length * length);
  const double t1 = (mesh.rest[e.p1] - mesh.rest[e.p2]).dot(along) / (length * length);
  const Coefficient fine[4] = {
      {e.p0, 1 / h0}, {e.p1, 1 / h1}, {e.p2, -(1 - t0) / h0 - (1 - t1) / h1}, {e.p3, -t0 / h0 - t1 / h1}};
  std::vector<Coefficient> coarse;
  for (const Coefficient& c : fine) {
    if (held[c.node]) continue;
    const Interpolation& from = level.finer[c.node];
    for (int k = 0; k < 3; ++k) {
      if (from.weight[k] == 0) continue;
      auto at = std::find_if(coarse.begin(), coarse.end(),
                             [&](const Coefficient& other) { return other.node == from.node[k]; });
      if (at == coarse.end()) at = coarse.insert(at, {from.node[k], 0});
      at->value += c.value * from.weight[k];
    }
  }
  return coarse;
}

void add(const std::vector<Coefficient>& a, const std::vector<Coefficient>& b, double factor,
         RestLevel& level) {
  for (const Coefficient& row : a)
    for (const Coefficient& column : b) {
      double& entry = row.node == column.node
                          ? level.plate_diagonal[row.node]
                          : level.plate_off_diagonal[slot_in_row(level.pattern, row.node, column.node)];
      entry += factor * row.value * column.value;
    }
}

void first_plate(const ClothMesh& mesh, const std::vector<char>& held, RestLevel& level) {
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const Edge& e = mesh.edge[i];
    const double length = (mesh.rest[e.p3] - mesh.rest[e.p2]).norm();
    const double height = (mesh.face_area[e.face0] + mesh.face_area[e.face1]) / length;  // (h0 + h1)/2
    const auto gradient = coarse_gradient(mesh, e, held, level);
    add(gradient, gradient, length / height, level);  // A/h^2 of the hinge, with A = |e| h
  }
}

void next_plate(const RestLevel& finer, RestLevel& level) {
  const auto seen = [&](int i) {
    std::vector<Coefficient> from;
    for (int k = 0; k < 3; ++k)
      if (level.finer[i].weight[k] > 0) from.push_back({level.finer[i].node[k], level.finer[i].weight[k]});
    return from;
  };
  for (int i = 0; i < finer.nodes; ++i) {
    const auto row = seen(i);
    add(row, row, finer.plate_diagonal[i], level);
    for (int j = finer.pattern.start[i]; j < finer.pattern.start[i + 1]; ++j)
      add(row, seen(finer.pattern.item[j]), finer.plate_off_diagonal[j], level);
  }
}

}  // namespace

RestHierarchy make_rest_hierarchy(const ClothMesh& mesh, const Adjacency& couplings,
                                  const std::vector<char>& held) {
  RestHierarchy hierarchy;
  Surface surface = mesh_surface(mesh);
  while (surface.size() > kCoarsestNodes) {
    const std::vector<char> root = choose_roots(surface);
    const std::vector<int> cell = cells(surface, root);
    Surface coarse = coarser(surface, root, cell);
    if (coarse.size() > kAcceptableFill * surface.size()) break;
    RestLevel level;
    level.nodes = coarse.size();
    level.finer = interpolations(surface, root, cell, coarse);
    const bool first = hierarchy.empty();
    auto rows = coarse_rows(first ? couplings : hierarchy.back().pattern, level);
    if (first) couple_hinges(mesh, level, rows);
    level.pattern = compressed(rows);
    level.plate_diagonal.assign(level.nodes, 0);
    level.plate_off_diagonal.assign(level.pattern.item.size(), 0);
    if (first)
      first_plate(mesh, held, level);
    else
      next_plate(hierarchy.back(), level);
    hierarchy.push_back(std::move(level));
    surface = std::move(coarse);
  }
  return hierarchy;
}

}  // namespace hysteron
