// How a quadrilateral becomes two triangles.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

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

// Whether the side a-b meets c-d, or b-c meets d-a, as where the corners are not given in their order around.
inline bool crosses_itself(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                           const Eigen::Vector3d& d) {
  constexpr double kNear = 0.1;  // of the side's length: the quad need not be plane
  const auto meet = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                       const Eigen::Vector3d& s) {
    const Eigen::Vector3d u = q - p, v = s - r, w = r - p;
    const double uv = u.dot(v), det = u.squaredNorm() * v.squaredNorm() - uv * uv;
    const double along = w.dot(u) * v.squaredNorm() - w.dot(v) * uv,
                 other = w.dot(u) * uv - w.dot(v) * u.squaredNorm();
    if (along <= 0 || along >= det || other <= 0 || other >= det) return false;
    return (w + other / det * v - along / det * u).norm() < kNear * std::min(u.norm(), v.norm());
  };
  return meet(a, b, c, d) || meet(b, c, d, a);
}

}  // namespace hysteron
