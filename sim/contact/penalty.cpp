#include "sim/contact/penalty.h"

#include <algorithm>

namespace hysteron {

double contact_stiffness_per_area(const Scene& scene) {
  constexpr double kSink = 1e-4;
  constexpr double kLeastGravity = 1;  // [m/s^2]: without gravity obstacles still push
  if (scene.contact_stiffness > 0) return scene.contact_stiffness;
  return scene.fabric.density * std::max(scene.gravity.norm(), kLeastGravity) /
         (kSink * scene.fabric.thickness);
}

}  // namespace hysteron
