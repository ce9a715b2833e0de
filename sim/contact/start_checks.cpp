#include "sim/contact/start_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "sim/base/error.h"
#include "sim/contact/body_vertices.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/self_touch.h"
#include "sim/mesh/corner_sets.h"
#include "sim/mesh/intersections.h"
#include "sim/scene/body.h"
#include "sim/scene/shown_key.h"

namespace hysteron {

namespace {

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", 1e3 * metres);
  return text;
}

void throw_if_crossing(const Cloth& cloth) {
  const auto pairs = intersecting_triangles(cloth.mesh.face, cloth.start);
  if (pairs.empty()) return;
  throw Error::invalid_input("self-contact: the cloth passes through itself at the start: triangles " +
                             pairs_text(pairs) + "; move its parts apart, or weld what is one (cloth.weld)");
}

struct NearPair {
  SelfPair<double> pair;
  double distance;  // [m]
};

// Returns pairs of the cloth, or of the cloth and the bodies behind it at x, that are too near to move.
std::vector<NearPair> too_near(const Scene& scene, const Cloth& cloth, const ClothMesh& all,
                               const std::vector<Eigen::Vector3d>& x, bool layers) {
  Cpu cpu(1);
  SelfPairs<double, Cpu> pairs(cpu, all, scene.fabric.thickness, cloth.mesh.vertices(), layers);
  const std::vector<Eigen::Vector3d> still(x.size(), Eigen::Vector3d::Zero());
  std::vector<char> held = cloth.held_throughout(scene);
  held.resize(x.size(), 1);
  pairs.find(x.data(), still.data(), 0, held.data(), 0);
  std::vector<NearPair> result;
  for (int p = 0; p < pairs.count(); ++p) {
    const SelfPair<double>& pair = pairs.pairs()[p];
    Eigen::Vector3d at[4];
    pair.gather(x.data(), at);
    const double distance = pair_distance(at, pair.is_edges());
    if (!(distance > least_distance(pair))) result.push_back({pair, distance});
  }
  return result;
}

const NearPair& nearest_of(const std::vector<NearPair>& pairs) {
  return *std::ranges::min_element(pairs, {}, &NearPair::distance);
}

// Names a pair: "vertex 12 and triangle 97", "edge 3-4 and edge 8-9".
std::string names(const SelfPair<double>& pair) {
  const auto edge = [&](int k) {
    return "edge " + std::to_string(pair.v[k]) + "-" + std::to_string(pair.v[k + 1]);
  };
  if (pair.is_edges()) return edge(0) + " and " + edge(2);
  return "vertex " + std::to_string(pair.v[0]) + " and triangle " + std::to_string(pair.other);
}

void throw_if_near(const Scene& scene, const Cloth& cloth) {
  const std::vector<NearPair> found = too_near(scene, cloth, cloth.mesh, cloth.start, true);
  if (found.empty()) return;
  const NearPair& nearest = nearest_of(found);
  throw Error::invalid_input("self-contact: the cloth starts too near to itself: " + names(nearest.pair) +
                             " are " + millimetres(nearest.distance) + " apart and must be more than " +
                             millimetres(least_distance(nearest.pair)) + " (fabric.thickness = " +
                             millimetres(scene.fabric.thickness) + "; " + std::to_string(found.size()) +
                             " such pairs in all): move its parts apart, or take a thinner fabric");
}

// Refuses cloth thicker than it is long, which has no layers: all of it is near at rest, and would be
// searched in vain.
void throw_if_thick(const Scene& scene, const ClothMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : mesh.rest) box.extend(x);
  const double extent = box.diagonal().norm();
  if (scene.fabric.thickness < extent) return;
  throw Error::invalid_input("self-contact: fabric.thickness = " + millimetres(scene.fabric.thickness) +
                             " (" + key_origin(scene, "fabric.thickness") + ") must be < " +
                             millimetres(extent) +
                             ", the cloth's diagonal: take a thinner fabric or a larger cloth");
}

void throw_if_immersed(const Scene& scene, const Cloth& cloth) {
  const auto set = obstacles_during<double>(scene.obstacle, scene.fabric.friction, 0, 0);
  const Immersion found = deepest(set, cloth.start, cloth.held(scene, 0));
  if (found.count == 0) return;
  const std::string origin = key_origin(scene, "obstacle[" + std::to_string(found.obstacle) + "]", "");
  throw Error::invalid_input(
      "obstacle: at the start " + immersion_text(found, scene.obstacle, cloth.start[found.vertex]) + ", of " +
      std::to_string(found.count) + " such vertices the deepest: move the cloth or the obstacle" +
      (origin.empty() ? "" : " (" + origin + ")"));
}

// Names a body: "obstacle[1] (mesh torso.obj)".
std::string body_name(const Scene& scene, std::size_t number) {
  return "obstacle[" + std::to_string(number) + "] (mesh " + scene.obstacle[number].file + ")";
}

std::string place_text(const Eigen::Vector3d& x) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) m", x.x(), x.y(), x.z());
  return text;
}

std::string move_apart(const Scene& scene, std::size_t number) {
  const std::string origin = key_origin(scene, "obstacle[" + std::to_string(number) + "]", "");
  return ": move the cloth or the obstacle" + (origin.empty() ? "" : " (" + origin + ")");
}

// Returns the triangles that are not held throughout.
std::vector<Eigen::Vector3i> moving_triangles(const Scene& scene, const Cloth& cloth) {
  const std::vector<char> held = cloth.held_throughout(scene);
  std::vector<Eigen::Vector3i> face;
  for (const Eigen::Vector3i& f : cloth.mesh.face)
    if (!held[f[0]] || !held[f[1]] || !held[f[2]]) face.push_back(f);
  return face;
}

// Returns how often a closed surface winds around a point: 1 inside one whose triangles face outward (solid
// angles by Van Oosterom & Strackee 1983).
double winding_number(const std::vector<Eigen::Vector3i>& face, const std::vector<Eigen::Vector3d>& x,
                      const Eigen::Vector3d& point) {
  double half_angles = 0;
  for (const Eigen::Vector3i& f : face) {
    const Eigen::Vector3d a = x[f[0]] - point, b = x[f[1]] - point, c = x[f[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.cross(b).dot(c), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2 * std::numbers::pi);
}

double distance_from(const std::vector<Eigen::Vector3i>& face, const std::vector<Eigen::Vector3d>& x,
                     const Eigen::Vector3d& point) {
  double least = INFINITY;
  for (const Eigen::Vector3i& f : face) {
    const Eigen::Vector3d corners[4] = {point, x[f[0]], x[f[1]], x[f[2]]};
    least = std::min(least, pair_distance(corners, false));
  }
  return least;
}

void throw_if_across(const Scene& scene, const Cloth& cloth, std::size_t number,
                     const std::vector<Eigen::Vector3i>& moving, const std::vector<Eigen::Vector3d>& x) {
  const BodyMesh& body = *scene.obstacle[number].mesh;
  const auto pairs = crossing_triangles({moving, cloth.start}, {body.face, x});
  if (pairs.empty()) return;
  const Eigen::Vector3i& first = moving[static_cast<std::size_t>(pairs.front().first)];
  const Eigen::Vector3d middle = (cloth.start[first[0]] + cloth.start[first[1]] + cloth.start[first[2]]) / 3;
  std::set<int> crossed;
  for (const auto& [of_cloth, of_body] : pairs) crossed.insert(of_cloth);
  throw Error::invalid_input("obstacle: at the start " + std::to_string(crossed.size()) +
                             " triangles of the cloth lie across the surface of " + body_name(scene, number) +
                             ", one of them at " + place_text(middle) + " across its triangle " +
                             std::to_string(pairs.front().second) + move_apart(scene, number));
}

// Refuses cloth inside a body: a part of the cloth that crosses no triangle is inside with all of its
// vertices, or with none.
void throw_if_inside(const Scene& scene, const Cloth& cloth, std::size_t number,
                     const std::vector<Eigen::Vector3i>& moving, const std::vector<Eigen::Vector3d>& x) {
  const BodyMesh& body = *scene.obstacle[number].mesh;
  if (!body.closed) return;
  Sets parts(cloth.mesh.vertices());
  for (const Eigen::Vector3i& f : moving) parts.join(f[0], f[1]), parts.join(f[1], f[2]);
  std::vector<int> size(cloth.start.size(), 0);
  for (const Eigen::Vector3i& f : moving) ++size[parts.root(f[0])];
  for (const Eigen::Vector3i& f : moving) {
    const int triangles = std::exchange(size[parts.root(f[0])], 0);
    if (triangles == 0) continue;
    const Eigen::Vector3d& at = cloth.start[f[0]];
    if (!(winding_number(body.face, x, at) > 0.5)) continue;
    throw Error::invalid_input(
        "obstacle: at the start " + std::to_string(triangles) + " triangles of the cloth lie inside " +
        body_name(scene, number) + ", " + vertex_text(f[0], at) + " of them " +
        millimetres(distance_from(body.face, x, at)) + " deep" + move_apart(scene, number));
  }
}

// Returns the body of the last vertex of a pair.
std::size_t number_of_body(const Scene& scene, const Cloth& cloth, const SelfPair<double>& pair) {
  int last = std::max(pair.v[0], pair.v[3]) - cloth.mesh.vertices();
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i) {
    if (!is_body(scene.obstacle[i])) continue;
    if (last < scene.obstacle[i].mesh->vertices()) return i;
    last -= scene.obstacle[i].mesh->vertices();
  }
  throw std::logic_error("a pair without body");
}

void throw_if_near_body(const Scene& scene, const Cloth& cloth) {
  std::vector<Eigen::Vector3d> x = cloth.start;
  const ClothMesh all = mesh_with_bodies(cloth.mesh, scene);
  x.insert(x.end(), all.rest.begin() + cloth.mesh.vertices(), all.rest.end());
  const std::vector<NearPair> found = too_near(scene, cloth, all, x, false);
  if (found.empty()) return;
  const NearPair& nearest = nearest_of(found);
  const std::size_t number = number_of_body(scene, cloth, nearest.pair);
  throw Error::invalid_input("obstacle: at the start the cloth is " + millimetres(nearest.distance) +
                             " from " + body_name(scene, number) + " at " + place_text(x[nearest.pair.v[0]]) +
                             " and must be more than " + millimetres(least_distance(nearest.pair)) +
                             " away, a tenth of its thickness (" + std::to_string(found.size()) +
                             " such pairs in all)" + move_apart(scene, number));
}

void throw_if_in_body(const Scene& scene, const Cloth& cloth) {
  const auto& obstacles = scene.obstacle;
  if (std::none_of(obstacles.begin(), obstacles.end(), is_body)) return;
  const std::vector<Eigen::Vector3i> moving = moving_triangles(scene, cloth);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!is_body(obstacles[i])) continue;
    const std::vector<Eigen::Vector3d> x = body_positions(obstacles[i], 0);
    throw_if_across(scene, cloth, i, moving, x);
    throw_if_inside(scene, cloth, i, moving, x);
  }
  throw_if_near_body(scene, cloth);
}

}  // namespace

void check_start(const Scene& scene, const Cloth& cloth) {
  if (scene.self_contact) {
    throw_if_thick(scene, cloth.mesh);
    throw_if_crossing(cloth);
    throw_if_near(scene, cloth);
  }
  throw_if_in_body(scene, cloth);
  throw_if_immersed(scene, cloth);
}

}  // namespace hysteron
