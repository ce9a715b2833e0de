// Small scenes that the tests of the solver share.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/scene/cloth.h"
#include "sim/scene/scene.h"
#include "sim/time/simulation.h"
#include "tests/sim/base/case_name.h"

namespace hysteron::test {

using Positions = std::vector<Eigen::Vector3d>;

// This struct has a scene on the CPU with its cloth, from which simulations start.
struct Trial {
  Scene scene;
  Cloth cloth;
  explicit Trial(const Scene& s) : scene(s), cloth(make_cloth(s)) {}
  std::unique_ptr<Simulation> simulation() const { return make_simulation(scene, cloth); }
  std::unique_ptr<Simulation> after(int steps) const {
    auto result = simulation();
    result->advance(steps);
    return result;
  }
  int steps(double seconds) const { return static_cast<int>(std::lround(seconds / scene.step)); }
  std::unique_ptr<Simulation> at(double seconds) const { return after(steps(seconds)); }
  double mass(int vertex) const { return scene.fabric.density * cloth.mesh.vertex_area[vertex]; }
};

// How a scene is computed: what tests of several methods run over, and the name of such a test.
struct Method {
  std::string law, element, integrator;
  std::string name() const { return law + "_" + element + "_" + integrator; }
};

inline Pin pin_at(double x, double y) {
  Pin pin;
  pin.select = PinSelection::nearest;
  pin.point = {x, y, 0};
  return pin;
}
inline Pin pin_in(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Pin pin;
  pin.low = low;
  pin.high = high;
  return pin;
}

inline Obstacle ground_at(double height) {
  Obstacle ground;
  ground.center = {0, 0, height};
  return ground;
}
inline Obstacle sphere_at(const Eigen::Vector3d& center, double radius) {
  Obstacle sphere;
  sphere.kind = ObstacleKind::sphere;
  sphere.center = center;
  sphere.radius = radius;
  return sphere;
}
inline Obstacle box_at(const Eigen::Vector3d& center, const Eigen::Vector3d& half) {
  Obstacle box;
  box.kind = ObstacleKind::box;
  box.center = center;
  box.size = half;
  return box;
}

// All that a fabric's bending may have beyond three numbers, on the scale of cotton broad; it sets early.
inline BendingParts all_parts() {
  return {{{2, 10, 40, 90}, {8e-6, 6e-6, 3e-6, 1e-6}},
          {{4, 12, 30, 70}, {5e-6, 4e-6, 2e-6, 1e-6}},
          {{1e-3, 0.1}, {6e-6, 3e-6}},
          {15, 6e-6}};
}

// Returns in-plane friction on the scale of a light fabric.
inline InPlaneStops in_plane_stops() {
  return {{{0.004}, {300}}, {{0.003, 0.01}, {200, 80}}, {{0.005, 0.03}, {90, 40}}};
}

// Returns a square of 0.2 m without pins or obstacles, with linear bending and a solver as exact as its
// arithmetic.
inline Scene free_square(int triangles = 200) {
  Scene scene;
  scene.cloth.length = 0.2;
  scene.triangles = triangles;
  scene.law = "linear";
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.solver_tolerance = 1e-12;
  scene.seconds = 100;
  return scene;
}

// Returns the same square hanging by two corners.
inline Scene hanging_square(int triangles = 200) {
  Scene scene = free_square(triangles);
  scene.pin = {pin_at(0, 0.2), pin_at(0.2, 0.2)};
  return scene;
}

// Returns a trial whose cloth starts from waves of some mm instead of flat, so that every force acts at once.
inline Trial rippled(const Scene& scene, double height) {
  Trial trial(scene);
  for (int i = 0; i < trial.cloth.mesh.vertices(); ++i) {
    const Eigen::Vector3d& x = trial.cloth.mesh.rest[i];
    trial.cloth.start[i] += height * Eigen::Vector3d(0.3 * std::sin(60 * x.y()), 0.2 * std::cos(50 * x.x()),
                                                     std::sin(40 * x.x() + 25 * x.y()));
  }
  return trial;
}

// Returns the part of a simulation that has this name.
inline ScenePart scene_part(const Simulation& simulation, const std::string& name) {
  for (const ScenePart& part : simulation.parts())
    if (part.name == name) return part;
  throw std::out_of_range("no part named " + name);
}

// This struct has sums over the vertices.
struct Momenta {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  double mass = 0, size = 0;  // size: of all vertices' momenta
};

inline Momenta momenta(const Trial& trial, Simulation& simulation) {
  Momenta sum;
  const auto x = simulation.positions(), v = simulation.velocities();
  for (int i = 0; i < trial.cloth.mesh.vertices(); ++i) {
    sum.linear += trial.mass(i) * v[i];
    sum.angular += trial.mass(i) * x[i].cross(v[i]);
    sum.mass += trial.mass(i);
    sum.size += trial.mass(i) * v[i].norm();
  }
  return sum;
}

inline double farthest(const Positions& a, const Positions& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, (a[i] - b[i]).norm());
  return result;
}

}  // namespace hysteron::test
