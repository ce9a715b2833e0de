#include "sim/contact/obstacle_set.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/enum_names.h"
#include "sim/base/rotation.h"
#include "sim/contact/compression.h"
#include "sim/scene/motion.h"

namespace hysteron {

namespace {

double radius_at_rest(const Obstacle& o) {
  switch (o.kind) {
    case ObstacleKind::box:
      return o.rim;
    case ObstacleKind::sphere:
    case ObstacleKind::capsule:
      return o.radius;
    case ObstacleKind::ground:
    case ObstacleKind::hollow:
    case ObstacleKind::cylinder:  // discs on whose rims recorded drapes hang
    case ObstacleKind::torus:
    case ObstacleKind::mesh:  // the contact of triangles is separate
      break;
  }
  return INFINITY;
}

}  // namespace

double sharpest_radius(const Obstacle& o) {
  double scale = 1;
  for (const Keyframe& key : o.motion.keys) scale = std::min(scale, key.scale);
  return scale * radius_at_rest(o);
}

template <class Real>
ObstacleSet<Real> obstacles_during(const std::vector<Obstacle>& obstacles, double fabric_friction,
                                   double start, double end) {
  ObstacleSet<Real> set;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Obstacle& o = obstacles[i];
    if (o.kind == ObstacleKind::mesh || start < o.from || start >= o.until) continue;
    const Placement now = placement(o.motion, end), then = placement(o.motion, start);
    const Eigen::Matrix3d own = rotation_between(Eigen::Vector3d::UnitZ(), o.axis.normalized());
    const Eigen::Matrix3d back = then.scale / now.scale * then.rotation * now.rotation.transpose();
    Obstacle3<Real>& item = set.item[set.count++];
    item.shape.kind = o.kind;
    const Eigen::Vector3d half =
        o.kind == ObstacleKind::box ? o.size : Eigen::Vector3d(o.radius, o.radius, o.height / 2);
    item.shape.half = (now.scale * half).cast<Real>();
    item.shape.rim = static_cast<Real>(now.scale * o.rim);
    item.rotation = (now.rotation * own).cast<Real>();
    item.center = now(o.center).cast<Real>();
    item.back_rotation = back.cast<Real>();
    item.back_translation = (then.translation - back * now.translation).cast<Real>();
    item.friction = static_cast<Real>(o.friction < 0 ? fabric_friction : o.friction);
    item.index = static_cast<int>(i);
    item.body = set.count - 1;
    for (int other = set.count - 2; other >= 0; --other)
      if (!o.body.empty() && obstacles[set.item[other].index].body == o.body) item.body = other;
    item.thinnest = static_cast<Real>(now.scale * obstacle_form(o).half_thickness);
    item.sharpest = static_cast<Real>(sharpest_radius(o));
  }
  return set;
}

std::vector<char> immersed(const ObstacleSet<double>& set, const std::vector<Eigen::Vector3d>& x) {
  std::vector<char> result;
  for (const Eigen::Vector3d& p : x) {
    bool deep = false;
    for (int o = 0; o < set.count; ++o) deep |= distance_to<double>(set.item[o], p).value < 0;
    result.push_back(deep);
  }
  return result;
}

Immersion deepest(const ObstacleSet<double>& set, const std::vector<Eigen::Vector3d>& x,
                  const std::vector<char>& exempted) {
  Immersion result;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (exempted[i]) continue;
    bool counted = false;
    for (int o = 0; o < set.count; ++o) {
      const double depth = -distance_to<double>(set.item[o], x[i]).value;
      if (!(depth > 0)) continue;
      result.count += !counted;
      counted = true;
      if (depth <= result.depth) continue;
      result.vertex = static_cast<int>(i);
      result.obstacle = set.item[o].index;
      result.depth = depth;
    }
  }
  return result;
}

bool is_squeezed(const ObstacleSet<double>& set, const ObstacleResponse<double>& response,
                 const Eigen::Vector3d& x, const Eigen::Vector3d& pressure) {
  const auto pressure_at = [&](double distance) {
    return distance < response.thickness ? -response.at(distance).slope : 0.0;
  };
  Distance<double> at[kMaxObstacles];
  for (int o = 0; o < set.count; ++o) {
    at[o] = distance_to<double>(set.item[o], x);
    at[o].normal = set.item[o].rotation * Eigen::Vector3d(at[o].normal);
  }
  for (int o = 0; o < set.count; ++o) {
    if (!(at[o].value < 0)) continue;
    double against = std::max(0.0, -pressure.dot(at[o].normal));
    for (int p = 0; p < set.count; ++p)
      if (set.item[p].body != set.item[o].body)
        against += pressure_at(at[p].value) * std::max(0.0, -at[p].normal.dot(at[o].normal));
    if (against >= pressure_at(at[o].value) / 2) return true;
  }
  return false;
}

std::string vertex_text(int vertex, const Eigen::Vector3d& x) {
  char text[120];
  std::snprintf(text, sizeof text, "vertex %d at (%.4g, %.4g, %.4g) m", vertex, x.x(), x.y(), x.z());
  return text;
}

std::string immersion_text(const Immersion& immersion, const std::vector<Obstacle>& obstacles,
                           const Eigen::Vector3d& at) {
  const ObstacleKind kind = obstacles[immersion.obstacle].kind;
  char depth[60];
  std::snprintf(depth, sizeof depth, " lies %.3g mm %s obstacle[%d] (", 1e3 * immersion.depth,
                kind == ObstacleKind::hollow ? "outside" : "inside", immersion.obstacle);
  return vertex_text(immersion.vertex, at) + depth + enum_name(kind) + ")";
}

template ObstacleSet<double> obstacles_during(const std::vector<Obstacle>&, double, double, double);
template ObstacleSet<float> obstacles_during(const std::vector<Obstacle>&, double, double, double);

double sharp_radius(const Scene& scene, const ClothMesh& mesh) {
  double longest = 0;  // squared edge
  for (const Edge& e : mesh.edge)
    longest = std::max(longest, (mesh.rest[e.p3] - mesh.rest[e.p2]).squaredNorm());
  return longest / (6 * (1 - kCompressed) * scene.fabric.thickness);
}

bool is_sharper_than_mesh(const Scene& scene, const ClothMesh& mesh) {
  const double sharp = sharp_radius(scene, mesh);
  return std::any_of(scene.obstacle.begin(), scene.obstacle.end(),
                     [&](const Obstacle& o) { return sharpest_radius(o) < sharp; });
}

}  // namespace hysteron
