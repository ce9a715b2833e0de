#include "experiments/specimens/clamped_mesh.h"

#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/fixed_keys.h"
#include "sim/base/error.h"
#include "sim/mesh/builders.h"

namespace hysteron::experiments {
namespace {

constexpr double kOnTheLine = 1e-9;  // tolerance of an end's vertices [m]

// The vertices and triangles that are added to the free cloth's mesh.
struct Growth {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector3i> triangles;
};

// Joins a column of cells, ending at x = `outer` [m], to the vertices of `mesh` at x = `inner` (both in its
// coordinates).
void add_column(const ClothMesh& mesh, double inner, double outer, double shift, Growth& growth) {
  std::vector<int> line;
  for (int i = 0; i < mesh.vertices(); ++i)
    if (std::abs(mesh.rest[i].x() - inner) < kOnTheLine) line.push_back(i);
  std::sort(line.begin(), line.end(), [&](int a, int b) { return mesh.rest[a].y() < mesh.rest[b].y(); });
  const int first = static_cast<int>(growth.points.size());
  for (int i : line) growth.points.emplace_back(outer + shift, mesh.rest[i].y());
  for (std::size_t j = 0; j + 1 < line.size(); ++j) {
    const int next = first + static_cast<int>(j), a = line[j], b = line[j + 1];
    if (outer > inner)
      growth.triangles.insert(growth.triangles.end(), {{a, next, next + 1}, {a, next + 1, b}});
    else
      growth.triangles.insert(growth.triangles.end(), {{next, a, b}, {next, b, next + 1}});
  }
}

}  // namespace

ClampedMesh clamped_mesh(const std::string& family, double free_length, double width, int triangles,
                         int clamps, unsigned seed) {
  check_length("strip", "length", free_length);
  check_length("strip", "width", width);
  check_triangles("strip", triangles);
  const MeshFamily kind = mesh_family(family);
  const double height = row_height(kind), cell = 2 * free_length * width / triangles;
  // Half a column of every clamp bends.
  const long wished = std::lround(free_length / std::sqrt(cell / height) - clamps / 2.0);
  // A strip that is far longer than wide has one row of cells, one that is far wider than long two columns;
  // neither has more triangles than requested.
  const int columns = static_cast<int>(std::clamp<long>(wished, 2, std::max(2, triangles)));
  const double d = free_length / (columns + clamps / 2.0);
  const int rows =
      static_cast<int>(std::clamp<long>(std::lround(width / (d * height)), 1, std::max(1, triangles)));
  const double between = columns * d;
  const ClothMesh mesh = make_grid(between, width, columns, rows, kind, seed);
  Growth growth;
  for (const Eigen::Vector3d& p : mesh.rest) growth.points.emplace_back(p.x() + d, p.y());
  growth.triangles = mesh.face;
  add_column(mesh, 0, -d, d, growth);
  if (clamps > 1) add_column(mesh, between, between + d, d, growth);
  return {flat_mesh(growth.points, std::move(growth.triangles), "strip"), d, between + clamps * d};
}

std::vector<FixedKey> unused_by_clamped_meshes() {
  return unused_but(
      "cloth.",
      {"cloth.shape", "cloth.length", "cloth.width", "cloth.position", "cloth.rotation", "cloth.warp-angle"},
      "the specimen is one flat rectangle, meshed to fit its clamp");
}

std::vector<FixedKey> decided_by_clamped_strips() {
  std::vector<FixedKey> keys = unused_by_clamped_meshes();
  keys.push_back({"cloth.shape", "the specimen is a strip"});
  keys.push_back({"pin", "clamps hold the strip"});
  return keys;
}

Pin held_between(double from, double to) {
  Pin pin;
  pin.low = {from, -1, -1};
  pin.high = {to, 1, 1};
  return pin;
}

Cloth clamp_at(Scene& scene, double line) {
  const ClothShape& shape = scene.cloth;
  if (!(shape.length > line))
    throw Error::invalid_input("cloth.length = " + std::to_string(shape.length) +
                               " m must be more than the " + std::to_string(line) + " m that are clamped")
        .with_key("cloth.length", std::to_string(shape.length));
  const double width = shape.side_along_weft();
  ClampedMesh clamped = clamped_mesh(scene.mesh, shape.length - line, width, scene.triangles, 1, scene.seed);
  for (Eigen::Vector3d& x : clamped.mesh.rest) x.x() += line - clamped.spacing / 2;
  scene.pin = {held_between(-1, line + clamped.spacing / 2)};
  return place_cloth(scene, std::move(clamped.mesh));
}

}  // namespace hysteron::experiments
