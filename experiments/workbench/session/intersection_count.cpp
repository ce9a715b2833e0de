#include "experiments/workbench/session/intersection_count.h"

#include <fmt/core.h>

#include "sim/mesh/intersections.h"

namespace hysteron::experiments {

IntersectionCount::Found IntersectionCount::found_in(double time,
                                                     const std::vector<Eigen::Vector3d>& x) const {
  const auto found = intersecting_triangles(face_, x);
  if (found.empty()) return {};
  const auto [a, b] = found.front();
  const Eigen::Vector3d& at = x[face_[a][0]];
  return {static_cast<long>(found.size()),
          fmt::format("{} pairs of triangles cross at t = {:.4f} s, the first are {} and {} near "
                      "({:.4f}, {:.4f}, {:.4f}) m",
                      found.size(), time, a, b, at.x(), at.y(), at.z())};
}

void IntersectionCount::watch(Session& session, const Snapshot& instant) {
  const auto stage = session.run().stage("intersections");
  see(instant.time, instant.x);
}

void IntersectionCount::finish(Session& session, const std::string&) {
  const auto stage = session.run().stage("intersections");
  session.run().metric("intersections", pairs());
}

void IntersectionCount::see(double time, const std::vector<Eigen::Vector3d>& x) {
  if (!behind_a_gpu_) return add(found_in(time, x));
  take();
  counting_ = std::async(std::launch::async, [this, time, x] { return found_in(time, x); });
}

void IntersectionCount::take() {
  if (counting_.valid()) add(counting_.get());
}

void IntersectionCount::add(const Found& found) {
  pairs_ += found.pairs;
  if (!found.line.empty()) tell_(found.line);
}

long IntersectionCount::pairs() {
  take();
  return pairs_;
}

void IntersectionCount::serialise(Archive& archive) {
  take();
  archive(pairs_);
}

}  // namespace hysteron::experiments
