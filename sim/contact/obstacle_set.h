// The obstacles of a scene during a step, and how deep vertices are in them.
#pragma once

#include <string>
#include <vector>

#include "sim/contact/compression.h"
#include "sim/contact/signed_distance.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline constexpr int kMaxObstacles = 12;  // they travel with each kernel launch by value

template <class Real>
struct Obstacle3 {
  Shape<Real> shape;
  Mat3<Real> rotation;  // from its own frame to the world's, at the end of the step
  Vec3<Real> center;
  Mat3<Real> back_rotation;  // from a world point of the obstacle at the step's end to that at its start
  Vec3<Real> back_translation;
  Real friction;
  int index;      // in the scene
  int body;       // the first of the set's obstacles of the same body; the obstacle itself without a body
  Real thinnest;  // half of its thinnest part [m]; infinite: it has no other side
  Real sharpest;  // least radius of curvature at its smallest [m]; infinite: sharpest_radius()

  HYST_HD bool is_thin() const { return thinnest < static_cast<Real>(1e30); }
};

template <class Real>
struct ObstacleSet {
  int count = 0;
  Obstacle3<Real> item[kMaxObstacles];

  bool has_thin() const {  // are there solids that have another side?
    for (int o = 0; o < count; ++o)
      if (item[o].is_thin()) return true;
    return false;
  }
};

template <class Real>
HYST_HD inline Distance<Real> distance_to(const Obstacle3<Real>& obstacle, const Vec3<Real>& x) {
  return signed_distance<Real>(obstacle.shape, obstacle.rotation.transpose() * (x - obstacle.center));
}

// The distance to the union of an obstacle's body.
template <class Real>
struct BodyDistance {
  Real value;           // [m]
  Vec3<Real> gradient;  // in the world
  int nearest;          // index of the nearest member in the set
  bool joins = false;   // the gradient is a blend of two members', and shorter than 1
};

// Returns the distance to the union.  Where two members meet it is rounded out over a width of `blend` [m]:
// the quadratic smooth minimum (Quilez 2013) is at most blend/4 below the lesser distance.
template <class Real>
HYST_HD BodyDistance<Real> distance_to_body(const ObstacleSet<Real>& set, int first, const Vec3<Real>& x,
                                            Real blend) {
  Distance<Real> d = distance_to(set.item[first], x);
  BodyDistance<Real> all{d.value, set.item[first].rotation * d.normal, first};
  Real least = d.value;
  for (int o = first + 1; o < set.count; ++o) {
    if (set.item[o].body != first) continue;
    d = distance_to(set.item[o], x);
    if (d.value < least) {
      least = d.value;
      all.nearest = o;
    }
    const Real between = Real(0.5) + (d.value - all.value) / (2 * blend);
    const Real share = between < 0 ? Real(0) : (between > 1 ? Real(1) : between);  // of the value so far
    all.joins |= share > 0 && share < 1;
    all.value = d.value + share * (all.value - d.value) - blend * share * (1 - share);
    all.gradient = share * all.gradient + (1 - share) * (set.item[o].rotation * d.normal);
  }
  return all;
}

// Returns the displacement over the step of the obstacle's point that is now at x [m].
template <class Real>
HYST_HD Vec3<Real> motion_over_step(const Obstacle3<Real>& obstacle, const Vec3<Real>& x) {
  return x - (obstacle.back_rotation * x + obstacle.back_translation);
}

// Returns it for the scene's obstacle `index`; zero where it is absent.
template <class Real>
HYST_HD Vec3<Real> surface_motion(const ObstacleSet<Real>& set, int index, const Vec3<Real>& x) {
  for (int o = 0; o < set.count; ++o)
    if (set.item[o].index == index) return motion_over_step(set.item[o], x);
  return Vec3<Real>::Zero();
}

// Returns the least radius of curvature of a box, sphere or capsule while its motion scales it [m].  It is
// infinite for shapes that are flat or not convex, and for cylinders, which act on vertices alone
// (docs/contact.md#sharp-obstacles).
double sharpest_radius(const Obstacle& obstacle);

// Returns the obstacles that are present during the step from `start` to `end` [s], except bodies of
// triangles (scene/body.h).
template <class Real>
ObstacleSet<Real> obstacles_during(const std::vector<Obstacle>& obstacles, double fabric_friction,
                                   double start, double end);

// A vertex in a solid (for `hollow`: outside): it started there, was hit hard, or is pinched.
struct Immersion {
  int vertex = -1, obstacle = -1;  // -1: none
  double depth = 0;                // below the surface [m]
  int count = 0;                   // number of vertices in solids
};

// Marks the vertices that are in one of the obstacles.
std::vector<char> immersed(const ObstacleSet<double>& set, const std::vector<Eigen::Vector3d>& x);

// Finds the deepest vertex that is not exempted and is in one of the obstacles.
Immersion deepest(const ObstacleSet<double>& set, const std::vector<Eigen::Vector3d>& x,
                  const std::vector<char>& exempted);

// Is a vertex at x that is in one obstacle pressed from its other side by at least half as much, by other
// obstacles, or by other layers with a `pressure` [Pa]?
bool is_squeezed(const ObstacleSet<double>& set, const ObstacleResponse<double>& response,
                 const Eigen::Vector3d& x, const Eigen::Vector3d& pressure);

// Describes it: "vertex 57 at (0.1, 0.2, 0) m lies 4.2 mm inside obstacle[1] (sphere)"; for `hollow`
// "outside".  `at` is where the vertex is in the world [m].
std::string immersion_text(const Immersion& immersion, const std::vector<Obstacle>& obstacles,
                           const Eigen::Vector3d& at);
// Names a vertex: "vertex 57 at (0.1, 0.2, 0) m".
std::string vertex_text(int vertex, const Eigen::Vector3d& x);

// Obstacles that are sharper than the cloth's mesh enter its triangles between vertices.

// Returns the radius of curvature [m] below which an obstacle is sharper than the mesh.
double sharp_radius(const Scene& scene, const ClothMesh& mesh);
bool is_sharper_than_mesh(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron
