// A square that is rolled up, and a ball that comes later, rolls and grows.
#pragma once

#include <cmath>
#include <numbers>

#include "experiments/workbench/animation/animated_scene.h"
#include "sim/mesh/builders.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {

struct MovingScene {
  static constexpr double kLength = 0.125;                    // [m]
  static constexpr double kTimes[] = {0, 0.125, 0.25, 0.75};  // [s]
  static constexpr double kCurvature[] = {0, 4, 8, 16};       // about y, at these [1/m]
  static constexpr double kRate = 8;                          // [1/s]
  static constexpr double kRadius = 0.03, kComes = 0.125, kGoes = 0.75, kGrows = 2;  // [m, s, s]

  static Eigen::Vector3f rolled(const Eigen::Vector3d& x, double curvature) {
    if (curvature == 0) return x.cast<float>();
    const double angle = curvature * x.x();
    return Eigen::Vector3d(std::sin(angle) / curvature, x.y(), (1 - std::cos(angle)) / curvature)
        .cast<float>();
  }
  std::vector<Eigen::Vector3f> points(std::size_t instant) const {
    std::vector<Eigen::Vector3f> all;
    for (const Eigen::Vector3d& x : mesh.rest) all.push_back(rolled(x, kCurvature[instant]));
    return all;
  }

  MovingScene() {
    Obstacle ball;
    ball.kind = ObstacleKind::sphere;
    ball.center = {0.1, 0.2, 0.3};
    ball.radius = kRadius;
    ball.from = kComes;
    ball.until = kGoes;
    ball.motion.center = ball.center;
    ball.motion.axis = {0, 1, 0};
    ball.motion.keys = {{0, {0, 0, 0}, 0, 1}, {kTimes[2], {0.05, 0, 0}, 90, kGrows}};
    Obstacle ground, hidden = ball;
    ground.center.z() = -0.5;
    hidden.visible = false;
    setup.scene.obstacle = {hidden, ball, ground};
    setup.options.size = "400x300";
    scene.view = picture_view(setup, {{-0.2f, -0.1f, 0}, {0.2f, 0.1f, 0.3f}}, {});
    scene.rate = kRate;
    for (std::size_t k = 0; k < std::size(kTimes); ++k) scene.instants.push_back({kTimes[k], k});
    scene.parts = {animated_cloth(mesh, setup.scene.cloth, scene.view)};
    scene.parts[0].points_at = [this](const Instant& at) { return points(at.number); };
    for (const AnimatedPart& body : animated_bodies(setup.scene, scene.view, 0.02f))
      scene.parts.push_back(body);
  }

  ClothMesh mesh = make_grid(kLength, kLength, 8, 8, MeshFamily::aligned, 1);
  Setup setup{default_scene(), {}};
  AnimatedScene scene;
};

}  // namespace hysteron::experiments
