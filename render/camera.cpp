#include "render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr float kMargin = 1.02f;  // scale that leaves a border around what is framed

// Returns the axes right, up and backward, as rows, of a camera that looks along `forward`.
Eigen::Matrix3f view_axes(const Eigen::Vector3f& forward, const Eigen::Vector3f& up) {
  const Eigen::Vector3f right = forward.cross(up).normalized();
  Eigen::Matrix3f axes;
  axes << right.transpose(), right.cross(forward).transpose(), -forward.transpose();
  return axes;
}

Eigen::Vector3f corner(const Box& box, int index) {
  return {index & 1 ? box.high.x() : box.low.x(), index & 2 ? box.high.y() : box.low.y(),
          index & 4 ? box.high.z() : box.low.z()};
}

// A vertical view needs another `up` than z.
Eigen::Vector3f up_for(const Eigen::Vector3f& forward) {
  const bool vertical = std::abs(forward.normalized().z()) > 0.999f;
  return vertical ? Eigen::Vector3f::UnitY() : Eigen::Vector3f::UnitZ();
}

}  // namespace

Box bounding_box(std::span<const float> positions) {
  if (positions.size() < 3) throw Error::invalid_input("bounding box: there are no points");
  Box box{{positions[0], positions[1], positions[2]}, {positions[0], positions[1], positions[2]}};
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    const Eigen::Vector3f point(positions[i], positions[i + 1], positions[i + 2]);
    if (!point.allFinite())
      throw Error::invalid_input("bounding box: point " + std::to_string(i / 3) + " is not finite");
    box = box.merged({point, point});
  }
  return box;
}

Camera Camera::perspective(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fov_degree) {
  const float distance = (target - eye).norm();
  if (!(distance > 0)) throw Error::invalid_input("camera: eye and target are the same point");
  if (!(fov_degree > 0 && fov_degree < 170))
    throw Error::invalid_input("camera: fov = " + std::to_string(fov_degree) +
                               " degree; allowed: above 0, below 170");
  Camera camera;
  camera.eye_ = eye;
  camera.target_ = target;
  camera.up_ = up_for(target - eye);
  camera.tan_half_fov_ = std::tan(fov_degree * std::numbers::pi_v<float> / 360);
  camera.near_ = 0.02f * distance;
  camera.far_ = 20 * distance;
  return camera;
}

Camera Camera::framing(const Box& box, const Eigen::Vector3f& direction, float fov_degree, float aspect) {
  const Eigen::Vector3f backward = direction.normalized(), center = box.center();
  const Eigen::Matrix3f axes = view_axes(-backward, up_for(backward));
  const float slope = std::tan(fov_degree * std::numbers::pi_v<float> / 360) / kMargin;
  float distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f p = axes * (corner(box, i) - center);
    distance =
        std::max({distance, p.z() + std::abs(p.y()) / slope, p.z() + std::abs(p.x()) / (slope * aspect)});
  }
  distance = std::max(distance, 1e-6f);
  Camera camera = perspective(center + distance * backward, center, fov_degree);
  // A long box seen from its end begins close to the eye.
  for (int i = 0; i < 8; ++i) {
    const float depth = distance - backward.dot(corner(box, i) - center);
    camera.near_ = std::min(camera.near_, 0.5f * depth);
  }
  return camera;
}

// The eye lies where the planes that bound the picture meet: along each axis of the view, the points nearest
// to the two borders say how far it has to be and where between them.
Camera Camera::around(std::span<const float> points, const Eigen::Vector3f& direction, float fov_degree,
                      float aspect, float margin) {
  const Box box = bounding_box(points);
  const Eigen::Vector3f backward = direction.normalized(), center = box.center();
  const Eigen::Matrix3f axes = view_axes(-backward, up_for(backward));
  const float slope = std::tan(fov_degree * std::numbers::pi_v<float> / 360) * (1 - 2 * margin);
  const Eigen::Vector2f slopes(slope * aspect, slope);
  const float inf = std::numeric_limits<float>::infinity();
  Eigen::Vector2f high(-inf, -inf), low(inf, inf);
  float nearest = -inf;
  for (size_t i = 0; i + 2 < points.size(); i += 3) {
    const Eigen::Vector3f p = axes * (Eigen::Vector3f(points[i], points[i + 1], points[i + 2]) - center);
    high = high.cwiseMax(p.head<2>() + slopes * p.z());
    low = low.cwiseMin(p.head<2>() - slopes * p.z());
    nearest = std::max(nearest, p.z());
  }
  const float distance =
      std::max(((high - low).array() / (2 * slopes.array())).maxCoeff(), nearest + 1e-3f * box.radius());
  const Eigen::Vector2f across = 0.5f * (high + low);
  const Eigen::Vector3f target = center + axes.transpose() * Eigen::Vector3f(across.x(), across.y(), 0);
  Camera camera = perspective(target + std::max(distance, 1e-6f) * backward, target, fov_degree);
  camera.near_ = std::min(camera.near_, std::max(0.5f * (distance - nearest), 1e-3f * camera.near_));
  return camera;
}

Camera Camera::top(const Box& box, float aspect) {
  const Eigen::Vector3f size = box.high - box.low, center = box.center();
  // The eye is far above, so that the near plane cuts off nothing that leaves the box a little.
  const float room = 2 * size.norm() + 1e-3f;
  Camera camera;
  camera.eye_ = {center.x(), center.y(), box.high.z() + room};
  camera.target_ = center;
  camera.up_ = Eigen::Vector3f::UnitY();
  camera.half_height_ = 0.5f * kMargin * std::max(size.y(), size.x() / aspect);
  camera.near_ = 0.05f * room;
  camera.far_ = size.z() + 3 * room;
  return camera;
}

Eigen::Matrix4f Camera::view() const {
  const Eigen::Matrix3f axes = view_axes((target_ - eye_).normalized(), up_);
  Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  view.topLeftCorner<3, 3>() = axes;
  view.topRightCorner<3, 1>() = -axes * eye_;
  return view;
}

Eigen::Matrix4f Camera::projection(float aspect, const Window& window) const {
  const double width = window.right - window.left, height = window.top - window.bottom;
  Eigen::Matrix4d crop = Eigen::Matrix4d::Identity();
  crop(0, 0) = 1 / width;
  crop(1, 1) = 1 / height;
  crop(0, 3) = (1 - window.left - window.right) / width;
  crop(1, 3) = (1 - window.bottom - window.top) / height;
  return (crop * centered_projection(aspect).cast<double>()).cast<float>();
}

Eigen::Matrix4f Camera::centered_projection(float aspect) const {
  Eigen::Matrix4f projection = Eigen::Matrix4f::Zero();
  const float depth = far_ - near_;
  if (is_orthographic()) {
    projection.diagonal() << 1 / (half_height_ * aspect), 1 / half_height_, -2 / depth, 1;
    projection(2, 3) = -(far_ + near_) / depth;
    return projection;
  }
  projection.diagonal() << 1 / (tan_half_fov_ * aspect), 1 / tan_half_fov_, -(far_ + near_) / depth, 0;
  projection(2, 3) = -2 * far_ * near_ / depth;
  projection(3, 2) = -1;
  return projection;
}

bool Camera::frames(std::span<const float> positions, float aspect) const {
  const Eigen::Matrix4f clip = projection(aspect) * view();
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    const Eigen::Vector4f at = clip * Eigen::Vector4f(positions[i], positions[i + 1], positions[i + 2], 1);
    if (!(at.head<3>().cwiseAbs().maxCoeff() <= at.w())) return false;
  }
  return true;
}

Eigen::Vector3f Camera::beside(float azimuth, float elevation) const {
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ(), right = forward().cross(up_).normalized();
  const float a = azimuth * std::numbers::pi_v<float> / 180, e = elevation * std::numbers::pi_v<float> / 180;
  return std::cos(e) * (std::cos(a) * right.cross(up) - std::sin(a) * right) + std::sin(e) * up;
}

float Camera::metres_per_pixel(int height) const {
  return 2 * (is_orthographic() ? half_height_ : tan_half_fov_) / static_cast<float>(height);
}
Window Camera::image_window(std::span<const float> points, float aspect) const {
  if (points.size() < 3) throw Error::invalid_input("window of a picture: there are no points");
  const Eigen::Matrix4f clip = projection(aspect) * view();
  const double inf = std::numeric_limits<double>::infinity();
  Window window{inf, inf, -inf, -inf};
  for (size_t i = 0; i + 2 < points.size(); i += 3) {
    const Eigen::Vector4f at = clip * Eigen::Vector4f(points[i], points[i + 1], points[i + 2], 1);
    const double x = 0.5 + 0.5 * at.x() / at.w(), y = 0.5 + 0.5 * at.y() / at.w();
    window = {std::min(window.left, x), std::min(window.bottom, y), std::max(window.right, x),
              std::max(window.top, y)};
  }
  return window;
}

float Camera::fov_degree() const { return 360 * std::atan(tan_half_fov_) / std::numbers::pi_v<float>; }

float Camera::metres_per_pixel(const Eigen::Vector3f& point, int height) const {
  const float distance = is_orthographic() ? 1 : (point - eye_).dot((target_ - eye_).normalized());
  return distance * metres_per_pixel(height);
}

}  // namespace hysteron::render
