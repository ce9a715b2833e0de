#include "sim/mesh/builders.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "sim/base/error.h"
#include "sim/mesh/random_points.h"
#include "sim/mesh/topology.h"

namespace hysteron {

namespace {

struct Flat {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector3i> triangles;
};

bool in_rows(MeshFamily family) {
  return family == MeshFamily::equilateral || family == MeshFamily::aligned45;
}

// Makes cells of size 1 x 1, with vertices row by row.
Flat square_cells(int nx, int ny, MeshFamily family) {
  Flat flat;
  const int row = nx + 1;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) flat.points.emplace_back(i, j);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = j * row + i, b = a + 1, c = b + row, d = a + row;
      if (rising_diagonal(family, i, j))
        flat.triangles.insert(flat.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        flat.triangles.insert(flat.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  }
  return flat;
}

// Makes rows of triangles of base 1 and height 1.  Odd rows are shifted by half a base; half triangles close
// the ends, so that the outline is straight.
Flat triangle_rows(int nx, int ny) {
  Flat flat;
  std::vector<int> start;
  for (int j = 0; j <= ny; ++j) {
    start.push_back(static_cast<int>(flat.points.size()));
    for (int i = 0; i <= nx + j % 2; ++i)
      flat.points.emplace_back(j % 2 ? std::clamp(i - 0.5, 0.0, double(nx)) : double(i), j);
  }
  for (int j = 0; j < ny; ++j) {
    const bool odd_below = j % 2;
    for (int i = 0; i <= nx; ++i) {
      const int shorter = start[odd_below ? j + 1 : j] + i, longer = start[odd_below ? j : j + 1] + i;
      if (odd_below) {
        flat.triangles.emplace_back(longer, longer + 1, shorter);
        if (i < nx) flat.triangles.emplace_back(longer + 1, shorter + 1, shorter);
      } else {
        flat.triangles.emplace_back(longer + 1, longer, shorter);
        if (i < nx) flat.triangles.emplace_back(shorter, shorter + 1, longer + 1);
      }
    }
  }
  return flat;
}

// Makes square cells whose interior vertices are moved at random; the boundary keeps its even spacing.
Flat random_cells(int nx, int ny, unsigned seed) {
  Flat flat;
  Uniform uniform(seed);
  std::vector<char> free;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const bool inside = i > 0 && i < nx && j > 0 && j < ny;
      const double dx = uniform(-kPointJitter, kPointJitter), dy = uniform(-kPointJitter, kPointJitter);
      flat.points.emplace_back(inside ? i + dx : i, inside ? j + dy : j);
      free.push_back(inside);
    }
  }
  flat.triangles = triangulate_relaxed(flat.points, free);
  return flat;
}

// Returns the numbers of cells for about `triangles` triangles: the pair that best balances the count and the
// cells' shape.
std::pair<int, int> cell_counts(double length, double width, int triangles, MeshFamily family) {
  const double height_over_width = row_height(family);
  const int extra = in_rows(family) ? 1 : 0;  // a row of n cells has 2 n + extra triangles
  const auto at_least_one = [](double n) { return std::clamp(std::round(n), 1.0, 0.5 * kMaxTriangles); };
  const auto columns = [&](double ny) { return at_least_one(0.5 * (triangles / ny - extra)); };
  const auto rows = [&](double nx) { return at_least_one(triangles / (2 * nx + extra)); };
  std::pair<double, double> best{1, 1};
  double least = INFINITY;
  const auto consider = [&](double nx, double ny) {
    const double aspect = (width / ny) / (length / nx * height_over_width);
    const double cost =
        4 * std::abs(std::log(ny * (2 * nx + extra) / triangles)) + std::abs(std::log(aspect));
    if (cost < least) least = cost, best = {nx, ny};
  };
  const double ideal = std::sqrt(0.5 * triangles * length / width * height_over_width);
  for (const double nx : {std::floor(ideal), std::ceil(ideal)})
    consider(at_least_one(nx), rows(at_least_one(nx)));
  for (const double ny : {std::floor(0.5 * triangles / ideal), std::ceil(0.5 * triangles / ideal)})
    consider(columns(at_least_one(ny)), at_least_one(ny));
  return {static_cast<int>(best.first), static_cast<int>(best.second)};
}

void check_size(double length, double width) {
  check_length("rectangle", "length", length);
  check_length("rectangle", "width", width);
}

}  // namespace

MeshFamily mesh_family(const std::string& name) {
  if (const auto family = value_if_named<MeshFamily>(name)) return *family;
  std::string allowed;
  for (const std::string& known : every_name<MeshFamily>()) allowed += (allowed.empty() ? "" : ", ") + known;
  throw Error::invalid_input("mesh family \"" + name + "\" is unknown; allowed: " + allowed);
}

double row_height(MeshFamily family) {
  if (family == MeshFamily::aligned45) return 0.5;
  return family == MeshFamily::equilateral ? std::sqrt(0.75) : 1;
}

void check_length(const std::string& what, const std::string& name, double value) {
  if (value > 0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << what << " mesh: " << name << " = " << value << " m must be > 0";
  throw Error::invalid_input(text.str());
}

void check_triangles(const std::string& what, int triangles) {
  if (triangles >= 2 && triangles <= kMaxTriangles) return;
  throw Error::invalid_input(what + " mesh: triangles = " + std::to_string(triangles) + " must be 2 to " +
                             std::to_string(kMaxTriangles));
}

bool rising_diagonal(MeshFamily family, int i, int j) {
  if (family == MeshFamily::unionjack) return (i + j) % 2 == 0;
  return family == MeshFamily::aligned;
}

ClothMesh flat_mesh(const std::vector<Eigen::Vector2d>& points, std::vector<Eigen::Vector3i> triangles,
                    const std::string& what) {
  const auto rotated = [](const Eigen::Vector3i& t) {
    int low = 0;
    t.minCoeff(&low);
    return std::array{t[low], t[(low + 1) % 3], t[(low + 2) % 3]};
  };
  std::sort(triangles.begin(), triangles.end(),
            [&](const auto& a, const auto& b) { return rotated(a) < rotated(b); });
  ClothMesh mesh;
  mesh.rest.reserve(points.size());
  for (const auto& p : points) mesh.rest.emplace_back(p.x(), p.y(), 0.0);
  mesh.face = std::move(triangles);
  build_topology(mesh, what);
  return mesh;
}

ClothMesh make_grid(double length, double width, int nx, int ny, MeshFamily family, unsigned seed) {
  check_size(length, width);
  if (nx < 1 || ny < 1 || nx > kMaxTriangles / ny)
    throw Error::invalid_input("rectangle mesh: " + std::to_string(nx) + " x " + std::to_string(ny) +
                               " cells must be at least 1 x 1 and at most " + std::to_string(kMaxTriangles));
  Flat flat = in_rows(family)                ? triangle_rows(nx, ny)
              : family == MeshFamily::random ? random_cells(nx, ny, seed)
                                             : square_cells(nx, ny, family);
  for (auto& p : flat.points) p = {length * (p.x() / nx), width * (p.y() / ny)};
  return flat_mesh(flat.points, std::move(flat.triangles), "rectangle mesh");
}

ClothMesh make_rectangle(double length, double width, int triangles, MeshFamily family, unsigned seed) {
  check_size(length, width);
  check_triangles("rectangle", triangles);
  const auto [nx, ny] = cell_counts(length, width, triangles, family);
  return make_grid(length, width, nx, ny, family, seed);
}

// A tube is a rectangle rolled up and sewn along its length, as a sleeve or a trouser leg is.

namespace {

// Is the seam closed? Boundary edges that lie on neither end are open: the two sides of the seam did not
// meet.
bool is_closed(const ClothMesh& mesh, double length) {
  const auto at_end = [&](int vertex) {
    const double x = mesh.rest[vertex].x();
    return std::min(std::abs(x), std::abs(x - length)) < 1e-9 * length;
  };
  for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e)
    if (!at_end(mesh.edge[e].p2) || !at_end(mesh.edge[e].p3)) return false;
  return true;
}

}  // namespace

ClothMesh make_tube(double length, double radius, int triangles, MeshFamily family, unsigned seed) {
  check_length("tube", "radius", radius);
  const double around = 2 * std::numbers::pi * radius;
  const ClothMesh flat = make_rectangle(length, around, triangles, family, seed);
  ClothMesh tube;
  std::vector<Eigen::Vector3d> rolled;
  for (const Eigen::Vector3d& x : flat.rest) {
    const double angle = x.y() / radius;
    rolled.push_back({x.x(), -radius * std::sin(angle), -radius * std::cos(angle)});
  }
  constexpr double kSeam = 1e-6;  // over the radius: far below any edge, far above rounding
  const std::vector<int> kept = nearby_representatives(rolled, kSeam * radius);
  std::vector<int> number(rolled.size());
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    number[i] = kept[i] < static_cast<int>(i) ? number[kept[i]] : static_cast<int>(tube.rest.size());
    if (kept[i] == static_cast<int>(i)) tube.rest.push_back(rolled[i]);
  }
  for (const Eigen::Vector3i& t : flat.face) tube.face.push_back({number[t[0]], number[t[1]], number[t[2]]});
  build_topology(tube, "tube mesh");
  if (!is_closed(tube, length))
    throw Error::invalid_input(
        "tube mesh: the two sides of the seam do not meet with mesh = " + enum_name(family) + " and " +
        std::to_string(triangles) + " triangles; take mesh = unionjack");
  return tube;
}

namespace {

constexpr int kPieces = 4;  // pieces of a triangle

// Returns the pieces by the vertices of the whole and the middles m_i opposite to them:
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

std::vector<Eigen::Vector3d> subdivide(const ClothMesh& mesh, std::vector<Eigen::Vector3d> x) {
  x.reserve(x.size() + mesh.edge.size());
  for (const Edge& e : mesh.edge) x.push_back((x[e.p2] + x[e.p3]) / 2);
  return x;
}

ClothMesh subdivided(const ClothMesh& mesh) {
  if (mesh.faces() > kMaxTriangles / kPieces)
    throw Error::invalid_input("subdivided mesh: 4 times " + std::to_string(mesh.faces()) +
                               " triangles must be at most " + std::to_string(kMaxTriangles));
  ClothMesh fine;
  fine.warp_axis = mesh.warp_axis;
  fine.sewn = mesh.sewn;
  fine.rest = subdivide(mesh, mesh.rest);
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
