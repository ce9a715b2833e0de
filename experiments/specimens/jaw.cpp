#include "experiments/specimens/jaw.h"

#include "render/look.h"

namespace hysteron::experiments {

Obstacle jaw(double from, double to, double width, const JawSize& size) {
  const double inset = render::Look{}.obstacle_inset;
  Obstacle box;
  box.kind = ObstacleKind::box;
  box.center = {(from + to) / 2, width / 2, 0};
  box.size = Eigen::Vector3d((to - from) / 2, width / 2 + size.overhang, size.thickness / 2).array() + inset;
  box.rim = 0.3 * inset;
  return box;
}

}  // namespace hysteron::experiments
