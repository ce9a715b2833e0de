#include "sim/scene/local_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {

namespace {

// The point of an infinite plane that is nearest to the cloth stands for it best: farther ones would bring
// their distance's rounding along.
Eigen::Vector3d near_origin(const Obstacle& o) {
  if (o.kind != ObstacleKind::ground) return o.center;
  const Eigen::Vector3d normal = o.axis.normalized();
  return normal * normal.dot(o.center);
}

}  // namespace

Eigen::Vector3d local_origin(const std::vector<Eigen::Vector3d>& x) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : x) box.extend(p);
  const Eigen::Vector3d middle = box.center();
  if (!(middle.norm() > kLocalBeyond * box.diagonal().norm())) return Eigen::Vector3d::Zero();
  return middle;
}

Scene seen_from(const Eigen::Vector3d& origin, Scene scene) {
  if (origin.isZero(0)) return scene;
  for (Pin& pin : scene.pin) pin.motion.center -= origin;
  for (Obstacle& o : scene.obstacle) {
    o.motion.center -= origin;
    o.center -= origin;
    o.center = near_origin(o);
  }
  return scene;
}

Cloth seen_from(const Eigen::Vector3d& origin, Cloth cloth) {
  if (origin.isZero(0)) return cloth;
  for (Eigen::Vector3d& x : cloth.start) x -= origin;
  return cloth;
}

double resolution(const Scene& scene, const Cloth& cloth, const std::vector<Eigen::Vector3d>& x) {
  const Eigen::Vector3d origin = local_origin(cloth.start);
  double largest = 0;
  for (const Eigen::Vector3d& p : x) largest = std::max(largest, (p - origin).cwiseAbs().maxCoeff());
  const bool fp32 = scene.precision == Precision::fp32;
  return largest * (fp32 ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
}

}  // namespace hysteron
