// Makes discs: an evenly spaced ring of vertices on the circle around a lattice or random points.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "sim/mesh/builders.h"
#include "sim/mesh/delaunay.h"
#include "sim/mesh/random_points.h"

namespace hysteron {
namespace {

// Lattice points stay this far inside the unit circle, in units of the lattice's spacing: farther would leave
// a wide gap, nearer makes flat triangles at the ring.  Chosen by the least angle over many sizes.
constexpr double kRingGap = 0.8;
constexpr double kPi = 3.14159265358979323846;
constexpr double kRowHeight = 0.86602540378443864676;  // of equilateral triangles, sqrt(3)/2

// The golden angle is pi (3 - sqrt 5).
constexpr double kGoldenCos = -0.73736887807831985, kGoldenSin = 0.67549029426152361;

struct Site {
  Eigen::Vector2d at;
  int i, j;  // lattice indices
};

// Returns the spacing that gives `triangles` triangles of the lattice's shape the area of the unit disc.
double even_spacing(int triangles, bool hexagonal) {
  return std::sqrt(2 * kPi / triangles / (hexagonal ? kRowHeight : 1.0));
}

// Returns the number of ring vertices at that spacing, a multiple of the lattice's symmetry.
int ring_count(double spacing, int symmetry) {
  return symmetry * std::max(1, static_cast<int>(std::lround(2 * kPi / spacing / symmetry)));
}

// Returns the lattice points inside the ring.  The centre of the disc is a lattice point, or else the middle
// of a cell.
std::vector<Site> lattice(double spacing, bool hexagonal, bool centred) {
  std::vector<Site> sites;
  const double reach = 1 - kRingGap * spacing, height = hexagonal ? kRowHeight : 1.0;
  const int n = static_cast<int>(1 / (spacing * height)) + 1;
  const double shift_x = centred ? 0.0 : 0.5, shift_y = centred ? 0.0 : hexagonal ? -kRowHeight / 3 : 0.5;
  for (int j = -n; j <= n; ++j) {
    for (int i = -n; i <= n; ++i) {
      const double x = i + shift_x + (hexagonal ? 0.5 * std::abs(j % 2) : 0.0), y = height * j + shift_y;
      if ((x * x + y * y) * spacing * spacing <= reach * reach)
        sites.push_back({{spacing * x, spacing * y}, i, j});
    }
  }
  return sites;
}

// A triangulation of n points with r of them on the hull has 2 n - r - 2 triangles.
int triangle_count(std::size_t sites, int ring) { return 2 * static_cast<int>(sites) + ring - 2; }

// Returns the lattice, over spacings near the even one and both centres, that comes closest to `triangles`.
std::pair<std::vector<Site>, int> fitting_lattice(int triangles, bool hexagonal) {
  std::pair<std::vector<Site>, int> best;
  int least = std::numeric_limits<int>::max();
  for (int step = 0; step <= 20; ++step) {
    for (const double factor : {1 + 0.005 * step, 1 - 0.005 * step}) {
      for (const bool centred : {true, false}) {
        const double spacing = factor * even_spacing(triangles, hexagonal);
        const int ring = ring_count(spacing, hexagonal ? 6 : 4);
        std::vector<Site> sites = lattice(spacing, hexagonal, centred);
        const int off = std::abs(triangle_count(sites.size(), ring) - triangles);
        if (off < least) least = off, best = {std::move(sites), ring};
      }
    }
  }
  return best;
}

void append_ring(std::vector<Eigen::Vector2d>& points, int ring) {
  for (int i = 0; i < ring; ++i) points.push_back(circle_point(i, ring));
}

// Sets the family's diagonal in every square cell whose corners all exist, where the Delaunay diagonal is
// arbitrary.
void set_diagonals(std::vector<Eigen::Vector3i>& triangles, const std::vector<Site>& sites,
                   MeshFamily family) {
  std::map<std::array<int, 2>, int> at;
  for (std::size_t v = 0; v < sites.size(); ++v) at[{sites[v].i, sites[v].j}] = static_cast<int>(v);
  const auto vertex = [&](int i, int j) {
    const auto found = at.find({i, j});
    return found == at.end() ? -1 : found->second;
  };
  const auto in_whole_cell = [&](const Eigen::Vector3i& t) {
    if (t.maxCoeff() >= static_cast<int>(sites.size())) return false;
    const auto [i0, i1] = std::minmax({sites[t[0]].i, sites[t[1]].i, sites[t[2]].i});
    const auto [j0, j1] = std::minmax({sites[t[0]].j, sites[t[1]].j, sites[t[2]].j});
    return i1 - i0 == 1 && j1 - j0 == 1 && vertex(i0, j0) >= 0 && vertex(i1, j0) >= 0 &&
           vertex(i0, j1) >= 0 && vertex(i1, j1) >= 0;
  };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), in_whole_cell), triangles.end());
  for (const Site& site : sites) {
    const int a = vertex(site.i, site.j), b = vertex(site.i + 1, site.j), c = vertex(site.i + 1, site.j + 1),
              d = vertex(site.i, site.j + 1);
    if (b < 0 || c < 0 || d < 0) continue;
    if (rising_diagonal(family, site.i, site.j))
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    else
      triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
  }
}

ClothMesh lattice_disc(double radius, int triangles, MeshFamily family) {
  const bool hexagonal = family == MeshFamily::equilateral, turned = family == MeshFamily::aligned45;
  const Eigen::Rotation2Dd turn(turned ? kPi / 4 : 0);
  if (turned) family = MeshFamily::flipped;  // the turn lays its diagonals along x
  const auto [sites, ring] = fitting_lattice(triangles, hexagonal);
  std::vector<Eigen::Vector2d> points;
  for (const Site& site : sites) points.push_back(site.at);
  append_ring(points, ring);
  std::vector<Eigen::Vector3i> faces = delaunay(points);
  if (!hexagonal) set_diagonals(faces, sites, family);
  for (auto& p : points) p = radius * (turned ? turn * p : p);
  return flat_mesh(points, std::move(faces), "disc mesh");
}

// Makes points of a sunflower (Vogel 1979), jittered: even in density and without a lattice's directions.
ClothMesh random_disc(double radius, int triangles, unsigned seed) {
  const double spacing = even_spacing(triangles, false);
  const int ring = ring_count(spacing, 1), inside = std::max(0, (triangles + 2 - ring + 1) / 2);
  Uniform uniform(seed);
  std::vector<Eigen::Vector2d> points;
  Eigen::Vector2d direction(1, 0);
  for (int k = 0; k < inside; ++k) {
    const double reach = (1 - 0.5 * spacing) * std::sqrt((k + 0.5) / inside);
    const double jitter = kPointJitter * spacing, dx = uniform(-jitter, jitter),
                 dy = uniform(-jitter, jitter);
    points.push_back(reach * direction + Eigen::Vector2d(dx, dy));
    const double limit = 1 - kRingGap * spacing, size = std::sqrt(points.back().squaredNorm());
    if (size > limit) points.back() *= limit / size;
    direction = {kGoldenCos * direction.x() - kGoldenSin * direction.y(),
                 kGoldenSin * direction.x() + kGoldenCos * direction.y()};
  }
  append_ring(points, ring);
  std::vector<char> free(points.size(), 0);
  std::fill_n(free.begin(), inside, 1);
  std::vector<Eigen::Vector3i> faces = triangulate_relaxed(points, free);
  for (auto& p : points) p *= radius;
  return flat_mesh(points, std::move(faces), "disc mesh");
}

}  // namespace

ClothMesh make_disc(double radius, int triangles, MeshFamily family, unsigned seed) {
  check_length("disc", "radius", radius);
  check_triangles("disc", triangles);
  return family == MeshFamily::random ? random_disc(radius, triangles, seed)
                                      : lattice_disc(radius, triangles, family);
}

}  // namespace hysteron
