#include "render/key_light.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hysteron::render {
namespace {

// The direction of the key light beside the camera [degree].
constexpr float kKeyAzimuth = 100, kKeyElevation = 30;
constexpr float kRaking = 0.2f;    // elevation of a raking light above the cloth's plane [rad]
constexpr float kMinAlong = 0.2f;  // least part of a light's direction that lies in that plane

}  // namespace

Eigen::Vector3f plane_normal(std::span<const float> xyz) {
  const auto count = static_cast<Eigen::Index>(xyz.size() / 3);
  const Eigen::Map<const Eigen::Matrix3Xf> points(xyz.data(), 3, count);
  const Eigen::Matrix3Xf from_middle = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(from_middle * from_middle.transpose());
  return axes.eigenvectors().col(0);
}

Eigen::Vector3f key_direction(const Look& look, const Camera& camera,
                              const std::optional<Eigen::Vector3f>& cloth_normal) {
  if (look.to_light) return *look.to_light;
  if (!look.raking) return camera.beside(kKeyAzimuth, kKeyElevation);
  const Eigen::Vector3f side = camera.beside(kKeyAzimuth, 0), eye = -camera.forward();
  Eigen::Vector3f normal = cloth_normal.value_or(eye);
  if (normal.dot(eye) < 0) normal = -normal;
  Eigen::Vector3f along = side - side.dot(normal) * normal;
  if (along.norm() < kMinAlong) along = Eigen::Vector3f::UnitZ() - normal.z() * normal;
  Eigen::Vector3f light = std::cos(kRaking) * along.normalized() + std::sin(kRaking) * normal;
  light.z() = std::max(light.z(), std::sin(kRaking));  // a ground, or the room's floor, hides what is lower
  return light;
}

}  // namespace hysteron::render
