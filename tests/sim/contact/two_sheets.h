// The tests of self-contact start from two sheets of one cloth, one above the other.
#pragma once

#include "tests/sim/time/scenes.h"

namespace hysteron::test {

inline constexpr double kUpperSide = 0.05;  // [m]

// Far apart at rest; the upper sheet starts `gap` [m] above the lower one, which reaches farther on all sides
// and is held.
inline Trial two_sheets(double gap, int triangles) {
  Scene scene = free_square(triangles);
  scene.law = "prandtl";
  scene.self_contact = true;
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 240;
  const ClothMesh lower =
      make_rectangle(1.4 * kUpperSide, 1.4 * kUpperSide, triangles, MeshFamily::random, 1);
  const ClothMesh upper = make_rectangle(kUpperSide, kUpperSide, triangles / 2, MeshFamily::random, 2);
  ClothMesh both = lower;
  for (const Eigen::Vector3d& x : upper.rest) both.rest.push_back(x + Eigen::Vector3d(1, 0, 0));
  for (const auto& f : upper.face) both.face.push_back(f.array() + lower.vertices());
  both.pattern.clear();
  build_topology(both, "two sheets");
  Trial trial(scene);
  trial.cloth = place_cloth(scene, both);
  for (int i = lower.vertices(); i < both.vertices(); ++i)
    trial.cloth.start[i] += Eigen::Vector3d(0.2 * kUpperSide - 1, 0.2 * kUpperSide, gap);
  trial.scene.pin = {Pin{}};
  trial.cloth.pin_vertices = {{}};
  for (int i = 0; i < lower.vertices(); ++i) {
    trial.cloth.pin[i] = 0;
    trial.cloth.pin_vertices[0].push_back(i);
  }
  return trial;
}

inline std::vector<int> upper_vertices(const Trial& trial) {
  std::vector<int> result;
  for (int i = 0; i < trial.cloth.mesh.vertices(); ++i)
    if (trial.cloth.pin[i] < 0) result.push_back(i);
  return result;
}

// The upper sheet, or its part up to `most_x` [m] from its own edge, gets a pin of its own.
inline void hold_upper(Trial& trial, const Pin& moving_pin, double most_x) {
  trial.scene.pin.push_back(moving_pin);
  trial.cloth.pin_vertices.emplace_back();
  for (int i : upper_vertices(trial)) {
    if (trial.cloth.mesh.rest[i].x() > 1 + most_x) continue;
    trial.cloth.pin[i] = 1;
    trial.cloth.pin_vertices[1].push_back(i);
  }
}

}  // namespace hysteron::test
