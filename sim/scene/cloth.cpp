#include "sim/scene/cloth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/builders.h"
#include "sim/mesh/file_extension.h"
#include "sim/mesh/garment.h"
#include "sim/scene/motion.h"
#include "sim/scene/shown_key.h"
#include "sim/scene/start_shape.h"

namespace hysteron {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kSelectionSlack = 1e-9;  // [m]: lets box corners meet grid vertices in spite of rounding

// Builds or reads one copy's mesh.  Warnings about a mesh that is read go into `warnings`.
ClothMesh one_rest_mesh(const Scene& scene, std::vector<std::string>& warnings) {
  const ClothShape& c = scene.cloth;
  const int triangles = scene.triangles / c.copies;
  if (names_an_obj(scene.mesh)) return read_obj(scene.mesh, c.weld, c.unit, &warnings);
  if (c.shape == ClothOutline::file) return read_obj(c.file, c.weld, c.unit, &warnings);
  if (c.shape == ClothOutline::pattern)
    return read_pattern(c.file, c.weld, c.texture_scale, c.unit, &warnings);
  const MeshFamily family = mesh_family(scene.mesh);
  if (c.shape == ClothOutline::disc) return make_disc(c.radius, triangles, family, scene.seed);
  if (c.shape == ClothOutline::tube) return make_tube(c.length, c.radius, triangles, family, scene.seed);
  return make_rectangle(c.length, c.side_along_weft(), triangles, family, scene.seed);
}

// Refuses copies whose boxes at rest are so near that contact takes them for neighbours in one cloth.
void check_copies(const Scene& scene, const ClothMesh& one) {
  const ClothShape& c = scene.cloth;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : one.rest) box.extend(x);
  const double gap = (c.copy_offset.cwiseAbs() - box.sizes()).cwiseMax(0.0).norm();
  const double least = 2 * scene.fabric.thickness;
  if (gap >= least) return;
  const std::string offset = "[" + number_text(c.copy_offset.x()) + ", " + number_text(c.copy_offset.y()) +
                             ", " + number_text(c.copy_offset.z()) + "]";
  throw Error::invalid_input(shown(scene, "cloth.copy-offset", offset, "m") + " leaves copies " +
                             number_text(gap) + " m apart, which must be >= " + number_text(least) +
                             " m, twice the fabric's thickness");
}

ClothMesh rest_mesh(const Scene& scene, std::vector<std::string>& warnings) {
  ClothMesh one = one_rest_mesh(scene, warnings);
  if (scene.cloth.copies == 1) return one;
  check_copies(scene, one);
  return copied_mesh(one, scene.cloth.copies, scene.cloth.copy_offset);
}

std::vector<int> selected(const ClothMesh& mesh, const Pin& pin) {
  std::vector<int> vertices;
  if (pin.select == PinSelection::nearest) {
    vertices.push_back(nearest_vertex(mesh, pin.point).vertex);
  } else if (pin.select == PinSelection::all_boundary) {
    for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e)
      vertices.insert(vertices.end(), {mesh.edge[e].p2, mesh.edge[e].p3});
  } else {
    for (int i = 0; i < mesh.vertices(); ++i)
      if (is_in_box(mesh.rest[i], pin.low, pin.high)) vertices.push_back(i);
  }
  return vertices;
}

// Describes the mesh's extent: "(0, 0, 0) to (0.2, 0.1, 0) m".
std::string reach_text(const ClothMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : mesh.rest) box.extend(x);
  const auto corner = [](const Eigen::Vector3d& x) {
    return "(" + number_text(x.x(), 3) + ", " + number_text(x.y(), 3) + ", " + number_text(x.z(), 3) + ")";
  };
  return corner(box.min()) + " to " + corner(box.max()) + " m";
}

Cloth placed(const Scene& scene, ClothMesh mesh, std::vector<Eigen::Vector3d> start) {
  Cloth cloth;
  cloth.mesh = std::move(mesh);
  cloth.start = std::move(start);
  const double warp = scene.cloth.warp_angle * kDegree;
  cloth.mesh.warp_axis = {std::cos(warp), std::sin(warp), 0};
  const Eigen::Matrix3d rotation = start_rotation(scene.cloth);
  for (Eigen::Vector3d& x : cloth.start) x = rotation * x + scene.cloth.position;
  cloth.pin.assign(cloth.mesh.vertices(), -1);
  for (std::size_t p = 0; p < scene.pin.size(); ++p) {
    cloth.pin_vertices.push_back(selected(cloth.mesh, scene.pin[p]));
    if (cloth.pin_vertices.back().empty())
      throw Error::invalid_input("pin " + std::to_string(p + 1) +
                                 ": its selection holds no vertex of the cloth, which reaches, where places "
                                 "are chosen, from " +
                                 reach_text(cloth.mesh));
    if (scene.pin[p].from > 0) continue;
    for (int vertex : cloth.pin_vertices.back()) cloth.pin[vertex] = static_cast<int>(p);
  }
  return cloth;
}

}  // namespace

NearestVertex nearest_vertex(const ClothMesh& mesh, const Eigen::Vector3d& point) {
  const auto nearest = std::ranges::min_element(
      mesh.rest, {}, [&](const Eigen::Vector3d& x) { return (x - point).squaredNorm(); });
  double longest = 0;
  for (const Edge& e : mesh.edge) longest = std::max(longest, (mesh.rest[e.p3] - mesh.rest[e.p2]).norm());
  const double height = mesh.rest.front().z();
  const bool is_level =
      std::ranges::all_of(mesh.rest, [&](const Eigen::Vector3d& x) { return x.z() == height; });
  Eigen::Vector3d between = *nearest - point;
  if (is_level) between.z() = 0;  // a flat cloth may lie at any height in its file
  const double distance = between.norm();
  return {static_cast<int>(nearest - mesh.rest.begin()), distance > longest ? distance : 0};
}

bool is_in_box(const Eigen::Vector3d& x, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return ((x - low).array() >= -kSelectionSlack).all() && ((high - x).array() >= -kSelectionSlack).all();
}

std::vector<Eigen::Vector3d> Cloth::element_centers(int dimension) const {
  std::vector<Eigen::Vector3d> centers;
  if (dimension == 1) {
    for (int e = 0; e < mesh.interior_edges; ++e)
      centers.push_back((mesh.rest[mesh.edge[e].p2] + mesh.rest[mesh.edge[e].p3]) / 2);
  } else {
    for (const auto& t : mesh.face)
      centers.push_back((mesh.rest[t[0]] + mesh.rest[t[1]] + mesh.rest[t[2]]) / 3);
  }
  return centers;
}

std::vector<int> Cloth::pins(const Scene& scene, double time) const {
  std::vector<int> result(pin.size(), -1);
  for (std::size_t i = 0; i < pin.size(); ++i)
    if (pin[i] >= 0 && time < scene.pin[pin[i]].until) result[i] = pin[i];
  for (std::size_t p = 0; p < scene.pin.size(); ++p)
    if (scene.pin[p].from > 0 && scene.pin[p].from <= time && time < scene.pin[p].until)
      for (int vertex : pin_vertices[p]) result[vertex] = static_cast<int>(p);
  return result;
}

std::vector<char> Cloth::held(const Scene& scene, double time) const {
  std::vector<char> result;
  for (int p : pins(scene, time)) result.push_back(p >= 0 && scene.pin[p].strength == 0);
  return result;
}

std::vector<char> Cloth::held_throughout(const Scene& scene) const {
  std::vector<char> result = held(scene, 0);
  for (const Pin& p : scene.pin) {
    const std::vector<char> later = held(scene, p.until);
    for (std::size_t i = 0; p.until <= scene.seconds && i < result.size(); ++i) result[i] &= later[i];
  }
  return result;
}

Cloth make_cloth(const Scene& scene) {
  std::vector<std::string> warnings;
  ClothMesh mesh = rest_mesh(scene, warnings);
  std::vector<Eigen::Vector3d> start = start_shape(scene, mesh);
  for (int i = 0; i < scene.cloth.subdivisions; ++i) {
    start = subdivide(mesh, std::move(start));
    mesh = subdivided(mesh);
  }
  for (const std::string& warning : cloth_warnings(scene, mesh, start)) warnings.push_back(warning);
  Cloth cloth = placed(scene, std::move(mesh), std::move(start));
  cloth.warnings = std::move(warnings);
  return cloth;
}

Cloth place_cloth(const Scene& scene, ClothMesh mesh) {
  std::vector<Eigen::Vector3d> start = mesh.rest;
  return placed(scene, std::move(mesh), std::move(start));
}

namespace {

// Represents an infinite plane by its point that is nearest to the cloth: farther points would bring their
// distance's rounding along.
Eigen::Vector3d near_origin(const Obstacle& o) {
  if (o.kind != ObstacleKind::ground) return o.center;
  const Eigen::Vector3d normal = o.axis.normalized();
  return normal * normal.dot(o.center);
}

}  // namespace

Eigen::Vector3d local_origin(const std::vector<Eigen::Vector3d>& x) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : x) box.extend(p);
  const Eigen::Vector3d middle = box.center();
  if (!(middle.norm() > kLocalBeyond * box.diagonal().norm())) return Eigen::Vector3d::Zero();
  return middle;
}

Scene relative_to(const Eigen::Vector3d& origin, Scene scene) {
  if (origin.isZero(0)) return scene;
  for (Pin& pin : scene.pin) pin.motion.center -= origin;
  for (Obstacle& o : scene.obstacle) {
    o.motion.center -= origin;
    o.center -= origin;
    o.center = near_origin(o);
  }
  return scene;
}

Cloth relative_to(const Eigen::Vector3d& origin, Cloth cloth) {
  if (origin.isZero(0)) return cloth;
  for (Eigen::Vector3d& x : cloth.start) x -= origin;
  return cloth;
}

double resolution(const Scene& scene, const Cloth& cloth, const std::vector<Eigen::Vector3d>& x) {
  const Eigen::Vector3d origin = local_origin(cloth.start);
  double largest = 0;
  for (const Eigen::Vector3d& p : x) largest = std::max(largest, (p - origin).cwiseAbs().maxCoeff());
  const bool fp32 = scene.precision == Precision::fp32;
  return largest * (fp32 ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
}

}  // namespace hysteron
