// Small scenes that the tests of the solver share.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "sim/scene/cloth.h"
#include "sim/scene/scene.h"
#include "sim/time/simulation.h"

namespace hysteron::test {

using Positions = std::vector<Eigen::Vector3d>;

// A scene on the CPU with its cloth, from which simulations start.
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
  double mass(int vertex) const { return scene.fabric.density * cloth.mesh.vertex_area[vertex]; }
};

// How a scene is computed: what tests of several methods run over, and the name of such a test.
struct Method {
  std::string law, element, integrator;
  std::string name() const {
    std::string name = law + "_" + element;
    std::replace(name.begin(), name.end(), '-', '_');
    std::string ending = "_" + integrator;
    std::replace(ending.begin(), ending.end(), '-', '_');
    return name + ending;
  }
};

inline Pin pin_at(double x, double y) {
  Pin pin;
  pin.select = "nearest";
  pin.point = {x, y, 0};
  return pin;
}

// All that a fabric's bending may have beyond three numbers, on the scale of cotton broad; it sets early.
inline BendingParts all_parts() {
  return {{{2, 10, 40, 90}, {8e-6, 6e-6, 3e-6, 1e-6}},
          {{4, 12, 30, 70}, {5e-6, 4e-6, 2e-6, 1e-6}},
          {{1e-3, 0.1}, {6e-6, 3e-6}},
          {15, 6e-6}};
}

// Friction in the plane on the scale of a light fabric.
inline InPlaneStops in_plane_stops() {
  return {{{0.004}, {300}}, {{0.003, 0.01}, {200, 80}}, {{0.005, 0.03}, {90, 40}}};
}

// A square of 0.2 m without pins or obstacles, linear bending, solver as exact as its arithmetic.
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

// The same hanging by two corners.
inline Scene hanging_square(int triangles = 200) {
  Scene scene = free_square(triangles);
  scene.pin = {pin_at(0, 0.2), pin_at(0.2, 0.2)};
  return scene;
}

// Starts from waves of some mm instead of flat, so that every force acts from the first step.
inline void ripple(Cloth& cloth, double height) {
  for (int i = 0; i < cloth.mesh.vertices(); ++i) {
    const Eigen::Vector3d& x = cloth.mesh.rest[i];
    cloth.start[i] += height * Eigen::Vector3d(0.3 * std::sin(60 * x.y()), 0.2 * std::cos(50 * x.x()),
                                               std::sin(40 * x.x() + 25 * x.y()));
  }
}

inline double farthest(const Positions& a, const Positions& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, (a[i] - b[i]).norm());
  return result;
}

}  // namespace hysteron::test
