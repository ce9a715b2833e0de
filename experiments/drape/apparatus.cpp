#include "experiments/drape/apparatus.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/contact/compression.h"

namespace hysteron::experiments {

double specimen_radius(const std::string& standard) { return standard == "jis" ? 0.127 : 0.15; }

DrapeChoice drape_by_standard(const std::string& standard) {
  DrapeChoice choice;
  choice.standard = standard;
  if (standard != "jis") return choice;
  choice.release = "shaken";
  choice.disc = 0.0635;
  choice.wait = 60;
  return choice;
}

namespace {

// Up and down, from when the plate has let go.
Motion shaking(const DrapeChoice& choice) {
  Motion motion;
  for (int k = 0; k <= 2 * choice.shakes; ++k) {
    Keyframe key;
    key.time = choice.lowered() + k * choice.period / 2;
    key.position.z() = k % 2 ? choice.stroke : 0;
    motion.keys.push_back(key);
  }
  return motion;
}

}  // namespace

void add_apparatus(Scene& scene, const DrapeChoice& choice, const Specimen& specimen) {
  // The discs press the specimen by a few times its own weight: both contacts stay closed, as in the
  // apparatus, and the plate throws nothing up when it goes down.
  constexpr double kOwnWeights = 4;
  const double pressure = kOwnWeights * scene.fabric.density * scene.gravity.norm();
  const double shell = distance_under(obstacle_shell(scene), pressure);
  scene.cloth.position += Eigen::Vector3d(0, 0, shell) - specimen.middle;
  Obstacle pedestal;
  pedestal.kind = ObstacleKind::cylinder;
  pedestal.radius = choice.disc;
  pedestal.height = kPedestalHeight;
  pedestal.center = {0, 0, -kPedestalHeight / 2};
  Obstacle clamp = pedestal;
  clamp.height = 0.01;
  clamp.center = {0, 0, 2 * shell + clamp.height / 2};
  clamp.visible = false;
  if (choice.release == "shaken") pedestal.motion = clamp.motion = shaking(choice);
  scene.obstacle.insert(scene.obstacle.end(), {pedestal, clamp});
  if (choice.release == "dropped") return;
  Obstacle plate = clamp;
  plate.motion = {};
  plate.radius = specimen.radius + 0.01;
  plate.center = {0, 0, -plate.height / 2};
  plate.friction = 0;
  for (int k = 0; k <= choice.strokes(); ++k) {
    Keyframe key;
    key.time = k * choice.lowering;
    key.position.z() = k % 2 ? -choice.plate : 0;
    plate.motion.keys.push_back(key);
  }
  plate.until = choice.lowered();
  scene.obstacle.push_back(plate);
}

void seed_folds(std::vector<Eigen::Vector3d>& start, const DrapeChoice& choice, double radius) {
  if (choice.folds == 0) return;
  if (choice.release != "dropped")
    throw Error::invalid_input("drape.folds needs drape.release = dropped: a plate would press them flat")
        .with_key("drape.folds", std::to_string(choice.folds));
  for (Eigen::Vector3d& x : start) {
    const double outside = std::max(0.0, (x.head<2>().norm() - choice.disc) / (radius - choice.disc));
    x.z() += kFoldSeed * outside * outside * std::cos(choice.folds * std::atan2(x.y(), x.x()));
  }
}

}  // namespace hysteron::experiments
