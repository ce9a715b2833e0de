// Prescribed motions of pins and obstacles, and the cloth's rotation at the start.
#pragma once

#include <Eigen/Geometry>

#include "sim/scene/scene.h"

namespace hysteron {

// The placement at time t [s] is x -> scale * rotation * x + translation [m], the identity at the motion's
// start position.  Keys are joined by monotone cubic interpolation (Fritsch & Butland 1984); the motion rests
// before the first and after the last, and each of its cycles is like the first.
struct Placement {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double scale = 1;
  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return scale * (rotation * x) + translation; }
};
Placement placement(const Motion& motion, double time);

// Returns the motion's state at `time` [s], as a keyframe.
Keyframe state_at(const Motion& motion, double time);

// Returns the motion that agrees with this one at `time` [s] and goes on from there with this velocity [m/s]
// and spin about its axis [degree/s].
Motion steady_from(const Motion& motion, double time, const Eigen::Vector3d& velocity, double spin);

// Returns the rotation of the cloth's placement: about x, y and z in this order.
Eigen::Matrix3d start_rotation(const ClothShape& shape);

// Returns the share of the way home that a pin has brought its vertices by `time` [s], rising smoothly from 0
// to 1; 0 if the pin does not go home.
double home_fraction(const Pin& pin, double time);

}  // namespace hysteron
