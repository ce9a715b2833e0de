#include "sim/base/rotation.h"

#include <Eigen/Geometry>

namespace hysteron {

Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

Eigen::Matrix3f rotation_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  return Eigen::Quaternionf::FromTwoVectors(from, to).toRotationMatrix();
}

}  // namespace hysteron
