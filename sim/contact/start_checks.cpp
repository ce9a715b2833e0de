#include "sim/contact/start_checks.h"

#include <Eigen/Geometry>
#include <cstdio>

#include "sim/base/error.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/self_touch.h"
#include "sim/mesh/intersections.h"
#include "sim/scene/shown_key.h"

namespace hysteron {

namespace {

constexpr std::size_t kNamed = 3;  // pairs that a message names

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", 1e3 * metres);
  return text;
}

// "12 and 97, 12 and 98, ... (31 pairs in all)"
std::string listed(const std::vector<std::pair<int, int>>& pairs) {
  std::string text;
  for (std::size_t i = 0; i < std::min(pairs.size(), kNamed); ++i)
    text += (i ? ", " : "") + std::to_string(pairs[i].first) + " and " + std::to_string(pairs[i].second);
  if (pairs.size() > kNamed) text += ", ... (" + std::to_string(pairs.size()) + " pairs in all)";
  return text;
}

void throw_if_crossing(const Cloth& cloth) {
  const auto pairs = intersecting_triangles(cloth.mesh.face, cloth.start);
  if (pairs.empty()) return;
  throw Error::invalid_input("self-contact: the cloth passes through itself at the start: triangles " +
                             listed(pairs) + "; move its parts apart, or weld what is one (cloth.weld)");
}

struct NearPair {
  SelfPair<double> pair;
  double distance;  // [m]
};

// From where no way is free.
std::vector<NearPair> too_near(const Scene& scene, const Cloth& cloth) {
  Cpu cpu(1);
  SelfPairs<double, Cpu> pairs(cpu, cloth.mesh, scene.fabric.thickness);
  const std::vector<Eigen::Vector3d> still(cloth.start.size(), Eigen::Vector3d::Zero());
  pairs.find(cloth.start.data(), still.data(), 0, cloth.held_throughout(scene).data(), 0);
  std::vector<NearPair> result;
  for (int p = 0; p < pairs.count(); ++p) {
    const SelfPair<double>& pair = pairs.pairs()[p];
    Eigen::Vector3d x[4];
    pair.gather(cloth.start.data(), x);
    const double distance = pair_distance(x, pair.is_edges());
    if (!(distance > least_distance(pair))) result.push_back({pair, distance});
  }
  return result;
}

// "vertex 12 and triangle 97", "edge 3-4 and edge 8-9"
std::string names(const SelfPair<double>& pair) {
  const auto edge = [&](int k) {
    return "edge " + std::to_string(pair.v[k]) + "-" + std::to_string(pair.v[k + 1]);
  };
  if (pair.is_edges()) return edge(0) + " and " + edge(2);
  return "vertex " + std::to_string(pair.v[0]) + " and triangle " + std::to_string(pair.other);
}

void throw_if_near(const Scene& scene, const Cloth& cloth) {
  const std::vector<NearPair> found = too_near(scene, cloth);
  if (found.empty()) return;
  const NearPair* nearest = &found[0];
  for (const NearPair& near : found)
    if (near.distance < nearest->distance) nearest = &near;
  throw Error::invalid_input("self-contact: the cloth starts too near to itself: " + names(nearest->pair) +
                             " are " + millimetres(nearest->distance) + " apart and must be more than " +
                             millimetres(least_distance(nearest->pair)) + " (fabric.thickness = " +
                             millimetres(scene.fabric.thickness) + "; " + std::to_string(found.size()) +
                             " such pairs in all): move its parts apart, or take a thinner fabric");
}

// Cloth thicker than it is long has no layers: all of it is near at rest, and looked at in vain.
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

}  // namespace

void check_start(const Scene& scene, const Cloth& cloth) {
  if (scene.self_contact) {
    throw_if_thick(scene, cloth.mesh);
    throw_if_crossing(cloth);
    throw_if_near(scene, cloth);
  }
  throw_if_immersed(scene, cloth);
}

}  // namespace hysteron
