#include "experiments/drape/apparatus.h"

#include "sim/contact/compression.h"

namespace hysteron::experiments {

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
  scene.obstacle.insert(scene.obstacle.end(), {pedestal, clamp});
  if (choice.release == "dropped") return;
  Obstacle plate = clamp;
  plate.radius = specimen.radius + 0.01;
  plate.center = {0, 0, -plate.height / 2};
  plate.friction = 0;
  for (int k = 0; k <= choice.strokes(); ++k) {
    Keyframe key;
    key.time = k * choice.lowering;
    key.position.z() = k % 2 ? -choice.plate : 0;
    plate.motion.keys.push_back(key);
  }
  plate.until = choice.released();
  scene.obstacle.push_back(plate);
}

}  // namespace hysteron::experiments
