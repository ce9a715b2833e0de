// Folds without a plate: a strip is wrapped around a rod, or a pleat is pulled straight.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/crease/specimen.h"
#include "experiments/specimens/clamped_mesh.h"

namespace hysteron::experiments {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTurn = 0.6, kRest = 0.1;  // durations [s]
constexpr int kKeys = 36;                   // key frames of the pin's path around the rod
constexpr double kHeldFraction = 0.2;       // held length at either end, over the specimen's length
constexpr double kAbove = 2e-3;             // height of the strip over z = 0 [m]
constexpr double kSlack = 2e-4;             // share of the path around the rod that is left loose
constexpr double kPleatRadius = 1.5;        // radius of the pleat's line, in thicknesses

// Returns the pin's motion about the rod's axis; the pin comes nearer to it as the rod takes up cloth.
Motion around_rod(double radius, const Eigen::Vector3d& axis_at) {
  Motion motion;
  motion.axis = {0, -1, 0};
  motion.center = axis_at;
  for (int k = 0; k <= kKeys; ++k) {
    const double angle = std::numbers::pi * k / kKeys, taken = radius * angle * (1 + kSlack);
    motion.keys.push_back(
        {kTurn * k / kKeys, -taken * Eigen::Vector3d(std::cos(angle), 0, std::sin(angle)), angle / kDegree});
  }
  return motion;
}

// Returns the rotation by `turn` [rad] that lays a limb straight on from where its pleat's line begins, about
// the one point for which all material of the line ends in its place.
Motion unfolding(double begin, double radius, double turn) {
  const Eigen::Rotation2Dd back(-turn);
  const Eigen::Vector2d folded{begin + radius * std::sin(turn), radius * (1 - std::cos(turn))};
  const Eigen::Vector2d straight{begin + radius * turn, 0};
  const Eigen::Matrix2d less = Eigen::Matrix2d::Identity() - back.toRotationMatrix();
  const Eigen::Vector2d center = less.colPivHouseholderQr().solve(straight - back * folded);
  Motion motion;
  motion.axis = {0, 1, 0};
  motion.center = {center.x(), 0, kAbove + center.y()};
  motion.keys = {{}, {kTurn, {0, 0, 0}, turn / kDegree}};
  return motion;
}

CreaseTimes soft_fold_times(const CreaseParams& choice) {
  CreaseTimes times{};
  times.folded = kTurn;
  times.pressed = times.folded + kRest;
  times.released = times.pressed + choice.hold;
  times.lifted = times.released;  // without a plate
  times.end = times.lifted + choice.recovery;
  return times;
}

Crease begun(const Scene& given, const CreaseParams& choice) {
  Crease crease{given, {}, soft_fold_times(choice)};
  crease.scene.seconds = crease.times.end;
  crease.scene.cloth.shape = ClothOutline::strip;
  crease.scene.cloth.position = {0, 0, kAbove};
  return crease;
}

Crease finished(Crease crease, ClothMesh mesh) {
  crease.scene.triangles = mesh.faces();
  crease.cloth = place_cloth(crease.scene, std::move(mesh));
  return crease;
}

}  // namespace

Crease wrapped(const Scene& given, const CreaseParams& choice) {
  Crease crease = begun(given, choice);
  Scene& scene = crease.scene;
  const double limbs = scene.cloth.length, taken = std::numbers::pi * choice.radius;
  scene.cloth.length = limbs + taken;
  crease.limb_part = kHeldFraction * limbs / scene.cloth.length;
  const double activation_distance =
      choice.radius + scene.fabric.thickness;  // radius of the cloth's middle around the rod
  const Eigen::Vector3d axis_at{limbs / 2, scene.cloth.width / 2, kAbove + activation_distance};
  Obstacle rod;
  rod.kind = ObstacleKind::cylinder;
  rod.axis = {0, 1, 0};
  rod.center = axis_at;
  rod.radius = choice.radius;
  rod.height = 2 * scene.cloth.width;
  rod.until = crease.times.released;
  scene.obstacle = {rod};
  Pin moving_pin = held_between(scene.cloth.length - kHeldFraction * limbs, 2 * scene.cloth.length);
  moving_pin.until = crease.times.released;
  moving_pin.motion = around_rod(activation_distance, axis_at);
  scene.pin = {held_between(-1, kHeldFraction * limbs), moving_pin};
  return finished(std::move(crease), crease_specimen(scene, taken / 2));
}

Crease pleated(const Scene& given, const CreaseParams& choice) {
  Crease crease = begun(given, choice);
  Scene& scene = crease.scene;
  const double length = scene.cloth.length, turn = 180 - choice.pleat;
  const double radius = kPleatRadius * scene.fabric.thickness, arc = radius * turn * kDegree;
  const double begin = (length - arc) / 2;  // where the pleat's line begins along the strip
  crease.rest_turn = turn;
  ClothMesh flat = crease_specimen(scene, std::max(arc, 2 * scene.fabric.thickness));
  ClothMesh mesh;
  mesh.face = flat.face;
  for (const Eigen::Vector3d& x : flat.rest) {
    mesh.pattern.push_back({x.x(), x.y()});
    const double along = x.x() - begin, angle = std::clamp(along / radius, 0.0, turn * kDegree);
    // Signed length before the pleat's line (< 0) or beyond it.
    const double straight = along - radius * angle;
    mesh.rest.push_back({begin + radius * std::sin(angle) + straight * std::cos(angle), x.y(),
                         radius * (1 - std::cos(angle)) + straight * std::sin(angle)});
  }
  build_topology(mesh, "pleated specimen");
  Pin clamp = crease_clamp(scene), moving_pin;
  moving_pin.low = moving_pin.high = mesh.rest.back();
  for (std::size_t i = 0; i < mesh.rest.size(); ++i)
    if (mesh.pattern[i].x() >= (1 - kHeldFraction) * length) {
      moving_pin.low = moving_pin.low.cwiseMin(mesh.rest[i]);
      moving_pin.high = moving_pin.high.cwiseMax(mesh.rest[i]);
    }
  moving_pin.until = crease.times.released;
  moving_pin.motion = unfolding(begin, radius, turn * kDegree);
  clamp.high.z() = 1e-9;
  scene.pin = {clamp, moving_pin};
  scene.obstacle.clear();
  return finished(std::move(crease), std::move(mesh));
}

}  // namespace hysteron::experiments
