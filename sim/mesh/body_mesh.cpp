#include "sim/mesh/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hysteron {
namespace {

// Returns the frame before time t [s], and the fraction of the way from there to the next one.
std::pair<std::size_t, double> place_in(const BodyMesh& body, double t) {
  const double last = static_cast<double>(body.frames.size() - 1);
  if (body.time.empty()) {
    const double at = std::clamp(t * body.fps, 0.0, last);
    return {static_cast<std::size_t>(at), at - std::floor(at)};
  }
  if (!(t > body.time.front())) return {0, 0};
  if (t >= body.time.back()) return {body.frames.size() - 1, 0};
  const auto after = std::upper_bound(body.time.begin(), body.time.end(), t);
  const auto before = static_cast<std::size_t>(after - body.time.begin()) - 1;
  return {before, (t - body.time[before]) / (*after - body.time[before])};
}

}  // namespace

std::vector<Eigen::Vector3d> BodyMesh::positions(double t) const {
  const auto [before, part] = place_in(*this, cycles.said(t));
  std::vector<Eigen::Vector3d> x = frames[before];
  if (!(part > 0)) return x;
  const std::vector<Eigen::Vector3d>& next = frames[before + 1];
  for (std::size_t v = 0; v < x.size(); ++v) x[v] += part * (next[v] - x[v]);
  return x;
}

}  // namespace hysteron
