// Bodies of triangles that tests make, and a sheet on one.
#pragma once

#include <map>
#include <numbers>

#include "sim/scene/body.h"
#include "tests/sim/time/scenes.h"

namespace hysteron::test {

// Returns a rigid body with these vertices [m].
inline Obstacle body_of(std::vector<Eigen::Vector3d> vertices, std::vector<Eigen::Vector3i> faces) {
  auto mesh = std::make_shared<BodyMesh>();
  mesh->face = std::move(faces);
  mesh->frames = {std::move(vertices)};
  Obstacle body;
  body.kind = ObstacleKind::mesh;
  body.mesh = mesh;
  return body;
}

// Returns a square plate of this half width around `center`, its front upwards, turned about y by `slope`.
inline Obstacle plate_at(const Eigen::Vector3d& center, double half, double slope = 0) {
  constexpr int kCells = 5;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> faces;
  const Eigen::AngleAxisd turn(slope, Eigen::Vector3d::UnitY());
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i)
      vertices.push_back(
          center + turn * Eigen::Vector3d(half * (2.0 * i / kCells - 1), half * (2.0 * j / kCells - 1), 0));
  const auto at = [](int i, int j) { return j * (kCells + 1) + i; };
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      faces.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      faces.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return body_of(vertices, faces);
}

// An octahedron whose faces are cut that many times, on a sphere.
inline Obstacle ball_at(const Eigen::Vector3d& center, double radius, int cuts = 3) {
  std::vector<Eigen::Vector3d> x = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Eigen::Vector3i> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(x.size()));
      if (fresh) x.push_back((x[a] + x[b]).normalized());
      return it->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const auto& f : faces) {
      const int a = between(f[0], f[1]), b = between(f[1], f[2]), c = between(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    faces = finer;
  }
  for (Eigen::Vector3d& v : x) v = center + radius * v;
  return body_of(x, faces);
}

// A sheet of 0.1 m that lies one thickness above a plate, which is tilted by `slope` about y.
inline Trial on_plate(double slope, double friction, Integrator integrator = Integrator::implicit) {
  Scene scene = free_square(60);
  scene.cloth.length = 0.1;
  scene.law = "prandtl";
  scene.integrator = integrator;
  scene.step = 1.0 / 240;
  scene.cloth.rotation = {0, slope * 180 / std::numbers::pi, 0};
  const Eigen::AngleAxisd turn(slope, Eigen::Vector3d::UnitY());
  scene.cloth.position = turn * Eigen::Vector3d(-0.05, -0.05, scene.fabric.thickness);
  Obstacle plate = plate_at(Eigen::Vector3d::Zero(), 0.2, slope);
  plate.friction = friction;
  scene.obstacle = {plate};
  return Trial(scene);
}

// The same sheet between two plates: the upper one, which has no inside either, comes down until they are
// `apart` [m], in `down` seconds, stays as long, and goes up again.
inline Trial between_plates(Integrator integrator, double apart, double down) {
  constexpr double kStart = 0.01;
  Trial trial = on_plate(0, 0.3, integrator);
  Obstacle upper = plate_at({0, 0, kStart}, 0.2);
  const Eigen::Vector3d way(0, 0, apart - kStart);
  upper.motion.keys = {{0, {0, 0, 0}, 0}, {down, way, 0}, {2 * down, way, 0}, {3 * down, {0, 0, 0}, 0}};
  trial.scene.obstacle.push_back(upper);
  return trial;
}

}  // namespace hysteron::test
