#include "render/inset.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace hysteron::render {
namespace {

constexpr float kMaxOfThickness = 0.35f;  // inset on either side: three tenths of a plate are left
// A chord of length s around an edge that turns by 60 degrees passes s/2 sin 30 = s/4 from it at most, and an
// edge that recedes by d along both its faces gives way by d (sin 30 + cos 30) across the chord.
constexpr float kEdgeFraction = 0.5f / (1 + std::numbers::sqrt3_v<float>);
constexpr double kNotExceeded = 0.9;

}  // namespace

BodyMeasure::BodyMeasure(const TriangleMesh& mesh) : roundness(mesh.roundness), centred(mesh.centred) {
  Eigen::Vector3f low = mesh.positions.front(), high = low;
  for (const Eigen::Vector3f& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  half_extent = 0.5f * (high - low);
}

float long_side(std::span<const int> triangles, std::span<const float> coordinates, int dimension) {
  using Point = Eigen::Map<const Eigen::VectorXf>;
  const auto at = [&](int vertex) {
    return Point(&coordinates[static_cast<size_t>(vertex) * static_cast<size_t>(dimension)], dimension);
  };
  std::vector<float> longest;
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Point a = at(triangles[t]), b = at(triangles[t + 1]), c = at(triangles[t + 2]);
    longest.push_back(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}));
  }
  if (longest.empty()) return 0;
  const auto nth =
      longest.begin() + static_cast<std::ptrdiff_t>(kNotExceeded * static_cast<double>(longest.size()));
  std::nth_element(longest.begin(), nth, longest.end());
  return *nth;
}

float cut_depth(float side, float roundness) {
  const float edge = kEdgeFraction * side;
  return roundness > 0 ? std::min(side * side / (6 * roundness), edge) : edge;
}

float body_inset(const BodyMeasure& body, float side, float least) {
  const float thickness = 2 * body.half_extent.minCoeff();
  return std::min(std::max(least, cut_depth(side, body.roundness)), kMaxOfThickness * thickness);
}

TriangleMesh shrunk(TriangleMesh mesh, float inset) {
  const Eigen::Array3f kept = 1 - inset / BodyMeasure(mesh).half_extent.array();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = mesh.centred ? (kept * mesh.positions[i].array()).matrix().eval()
                                     : (mesh.positions[i] - inset * mesh.normals[i]).eval();
  return mesh;
}

}  // namespace hysteron::render
