#include "sim/mesh/body_mesh.h"

#include <algorithm>
#include <cmath>

namespace hysteron {

std::vector<Eigen::Vector3d> BodyMesh::positions(double time) const {
  const double last = static_cast<double>(frames.size() - 1), at = std::clamp(time * fps, 0.0, last);
  const auto before = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(before);
  std::vector<Eigen::Vector3d> x = frames[before];
  if (!(part > 0)) return x;
  const std::vector<Eigen::Vector3d>& next = frames[before + 1];
  for (std::size_t v = 0; v < x.size(); ++v) x[v] += part * (next[v] - x[v]);
  return x;
}

}  // namespace hysteron
