// Where the coordinates of a simulation begin.  Far from the world's origin the rounding of a position, above
// all in single precision, is that of the distance and not of the cloth: there positions are relative to
// where the cloth starts.
#pragma once

#include <vector>

#include "sim/scene/cloth.h"
#include "sim/scene/scene.h"

namespace hysteron {

// The middle of these positions; zero, exactly, where the world's origin is within kLocalBeyond of their
// diagonals [m].
inline constexpr double kLocalBeyond = 10;
Eigen::Vector3d local_origin(const std::vector<Eigen::Vector3d>& x);

// The same with all positions relative to `origin` [m].  What is chosen on the flat cloth, and keyframes,
// which are relative to the start, stay as they are.
Scene seen_from(const Eigen::Vector3d& origin, Scene scene);
Cloth seen_from(const Eigen::Vector3d& origin, Cloth cloth);

// What rounding in the scene's precision makes of these positions in the world [m], where cloth has gone
// farthest from its start: their distance from the next number [m].
double resolution(const Scene& scene, const Cloth& cloth, const std::vector<Eigen::Vector3d>& x);

}  // namespace hysteron
