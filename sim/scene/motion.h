// Prescribed motions of pins and obstacles, and how the cloth is turned at the start.
#pragma once

#include <Eigen/Geometry>

#include "sim/scene/scene.h"

namespace hysteron {

// Placement at time t [s]: x -> scale * rotation * x + translation, identity at the motion's start position.
// Between keys monotone cubic interpolation (Fritsch & Butland 1984), at rest before the first and after the
// last; in each of the motion's cycles as in the first.
struct Placement {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double scale = 1;
  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return scale * (rotation * x) + translation; }
};
Placement placement(const Motion& motion, double time);

// Where the motion is at that time [s], as a keyframe.
Keyframe state_at(const Motion& motion, double time);

// The motion that is where this one is at `time` [s] and goes on from there with this velocity [m/s] and spin
// about its axis [degree/s].
Motion steady_from(const Motion& motion, double time, const Eigen::Vector3d& velocity, double spin);

// Of the cloth as it is placed: about x, y and z in this order.
Eigen::Matrix3d start_rotation(const ClothShape& shape);

// Share of the way home that a pin has brought its vertices by then, smoothly from 0 to 1; 0 if it does not.
double home_fraction(const Pin& pin, double time);

}  // namespace hysteron
