#include "sim/mesh/builders.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "sim/error.h"
#include "sim/mesh/random_points.h"

namespace hysteron {
namespace {

constexpr std::pair<MeshFamily, const char*> kFamilies[] = {{MeshFamily::aligned, "aligned"},
                                                            {MeshFamily::flipped, "flipped"},
                                                            {MeshFamily::unionjack, "unionjack"},
                                                            {MeshFamily::equilateral, "equilateral"},
                                                            {MeshFamily::random, "random"}};

// A random point keeps this much of a cell's half width from its neighbours' cells.
constexpr double kJitter = 0.42;

struct Flat {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector3i> triangles;
};

// Cells of size 1 x 1, vertices row by row.
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

// Rows of triangles of base 1 and height 1.  Odd rows are shifted by half a base; half triangles close the
// ends, so that the outline is straight.
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

// Interior vertices of the square cells at random; the boundary keeps its even spacing.
Flat random_cells(int nx, int ny, unsigned seed) {
  Flat flat;
  Uniform uniform(seed);
  std::vector<char> free;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const bool inside = i > 0 && i < nx && j > 0 && j < ny;
      const double dx = uniform(-kJitter, kJitter), dy = uniform(-kJitter, kJitter);
      flat.points.emplace_back(inside ? i + dx : i, inside ? j + dy : j);
      free.push_back(inside);
    }
  }
  flat.triangles = triangulate_relaxed(flat.points, free);
  return flat;
}

// Numbers of cells for about `triangles` triangles of which each cell has two, of the given height over
// width: the pair that best weighs the count against the shape of the cells.
std::pair<int, int> cell_counts(double length, double width, int triangles, double cell_aspect) {
  const double cells = 0.5 * triangles;
  const double ideal_nx = std::sqrt(cells * length / width * cell_aspect), ideal_ny = cells / ideal_nx;
  const auto at_least_one = [](double n) { return std::clamp(std::round(n), 1.0, 0.5 * kMostTriangles); };
  std::pair<double, double> best{1, 1};
  double least = INFINITY;
  const auto consider = [&](double nx, double ny) {
    const double aspect = (width / ny) / (length / nx * cell_aspect);
    const double cost = 4 * std::abs(std::log(nx * ny / cells)) + std::abs(std::log(aspect));
    if (cost < least) least = cost, best = {nx, ny};
  };
  for (const double round : {std::floor(ideal_nx), std::ceil(ideal_nx)})
    consider(at_least_one(round), at_least_one(cells / at_least_one(round)));
  for (const double round : {std::floor(ideal_ny), std::ceil(ideal_ny)})
    consider(at_least_one(cells / at_least_one(round)), at_least_one(round));
  return {static_cast<int>(best.first), static_cast<int>(best.second)};
}

void check_size(double length, double width) {
  check_length("rectangle", "length", length);
  check_length("rectangle", "width", width);
}

}  // namespace

MeshFamily mesh_family(const std::string& name) {
  std::string allowed;
  for (const auto& [family, text] : kFamilies) {
    if (name == text) return family;
    allowed += std::string(allowed.empty() ? "" : ", ") + text;
  }
  throw Error::request("mesh family \"" + name + "\" is unknown; allowed: " + allowed);
}

std::string to_string(MeshFamily family) {
  for (const auto& [known, text] : kFamilies)
    if (known == family) return text;
  throw Error::request("mesh family number " + std::to_string(static_cast<int>(family)) + " is unknown");
}

void check_length(const std::string& what, const std::string& name, double value) {
  if (value > 0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << what << " mesh: " << name << " = " << value << " m must be > 0";
  throw Error::request(text.str());
}

void check_triangles(const std::string& what, int triangles) {
  if (triangles >= 2 && triangles <= kMostTriangles) return;
  throw Error::request(what + " mesh: triangles = " + std::to_string(triangles) + " must be 2 to " +
                       std::to_string(kMostTriangles));
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
  if (nx < 1 || ny < 1 || nx > kMostTriangles / 2 / ny)
    throw Error::request("rectangle mesh: " + std::to_string(nx) + " x " + std::to_string(ny) +
                         " cells must be at least 1 x 1 and at most " + std::to_string(kMostTriangles / 2) +
                         " in all");
  Flat flat = family == MeshFamily::equilateral ? triangle_rows(nx, ny)
              : family == MeshFamily::random    ? random_cells(nx, ny, seed)
                                                : square_cells(nx, ny, family);
  for (auto& p : flat.points) p = {length * (p.x() / nx), width * (p.y() / ny)};
  return flat_mesh(flat.points, std::move(flat.triangles), "rectangle mesh");
}

ClothMesh make_rectangle(double length, double width, int triangles, MeshFamily family, unsigned seed) {
  check_size(length, width);
  check_triangles("rectangle", triangles);
  const double aspect = family == MeshFamily::equilateral ? std::sqrt(0.75) : 1.0;
  const auto [nx, ny] = cell_counts(length, width, triangles, aspect);
  return make_grid(length, width, nx, ny, family, seed);
}

}  // namespace hysteron
