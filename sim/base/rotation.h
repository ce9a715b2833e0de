// Rotations from one direction to another.
#pragma once

#include <Eigen/Core>

namespace hysteron {

// Returns the rotation by the least angle that takes the direction of `from` to that of `to`, neither of
// which is zero; of opposite directions, one by half a turn.  Eigen finds that one by a singular value
// decomposition, whose templates take g++ seven seconds: they are compiled here alone.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
Eigen::Matrix3f rotation_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

}  // namespace hysteron
