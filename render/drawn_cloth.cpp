#include "render/drawn_cloth.h"

#include <algorithm>
#include <utility>

#include "render/inset.h"
#include "render/key_light.h"

namespace hysteron::render {

DrawnCloth::DrawnCloth(const GlFunctions& gl, const ClothTopology& topology)
    : surface_(gl, topology),
      triangles_(topology.triangles.begin(), topology.triangles.end()),
      side_(topology.pattern.empty() ? 0 : long_side(topology.triangles, topology.pattern, 2)) {}

bool DrawnCloth::has(std::span<const float> xyz) const { return std::ranges::equal(xyz, positions_); }

void DrawnCloth::set_positions(std::span<const float> xyz) {
  surface_.set_positions(xyz);
  positions_.assign(xyz.begin(), xyz.end());
  if (!triangles_.empty()) side_ = long_side(std::exchange(triangles_, {}), xyz, 3);
}

void DrawnCloth::measure_box() { box_ = bounding_box(positions_); }

std::optional<Eigen::Vector3f> DrawnCloth::normal() const {
  if (positions_.empty()) return {};
  return plane_normal(positions_);
}

bool DrawnCloth::write_positions(std::string& reason) {
  positions_.clear();
  box_.reset();
  if (shared_positions_->write(reason)) return true;
  shared_positions_.reset();
  return false;
}

void DrawnCloth::set_side(float side) {
  side_ = side;
  triangles_.clear();
}

void place_cloth(const Program& program) {
  program.set("keep", Eigen::Vector3f(1, 1, 1));
  program.set("inset", 0.0f);
  program.set("model", Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
}

}  // namespace hysteron::render
