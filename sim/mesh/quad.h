// How a quadrilateral becomes two triangles.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hysteron {

// A quad a, b, c, d is cut along its shorter diagonal, unless only the other one lies inside it.  True: along
// a-c, into (a, b, c) and (a, c, d); false: along b-d, into (a, b, d) and (b, c, d).
inline bool is_cut_from_first(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                              const Eigen::Vector3d& d) {
  const auto folded = [](const auto& p, const auto& q, const auto& r, const auto& s) {  // along p-r
    return (q - p).cross(r - p).dot((r - p).cross(s - p)) <= 0;
  };
  const bool first = folded(a, b, c, d), second = folded(b, c, d, a);
  if (first != second) return second;
  return (c - a).norm() <= (d - b).norm();
}

}  // namespace hysteron
