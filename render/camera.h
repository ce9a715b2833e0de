// Where a picture is taken from.  World axes: z up, metres.
#pragma once

#include <Eigen/Core>
#include <span>

namespace hysteron::render {

struct Box {
  Eigen::Vector3f low{0, 0, 0}, high{0, 0, 0};

  Eigen::Vector3f center() const { return 0.5f * (low + high); }
  float radius() const { return 0.5f * (high - low).norm(); }
  Box merged(const Box& other) const { return {low.cwiseMin(other.low), high.cwiseMax(other.high)}; }
};

// Box of points given as x, y, z each.  Error::invalid_input if there are none or one is not finite.
Box bounding_box(std::span<const float> positions);

// Part of a picture, in shares of its width and height from its lower left corner; it may reach beyond.
struct Window {
  double left = 0, bottom = 0, right = 1, top = 1;
};

class Camera {
 public:
  // `fov_degree`: full vertical angle.
  static Camera perspective(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fov_degree);

  // Perspective; looks at the box against `direction` (from the box to the eye), as near as the box stays
  // whole in a picture of this aspect (width / height).  For a sequence give the box of all its frames.
  static Camera framing(const Box& box, const Eigen::Vector3f& direction, float fov_degree, float aspect);

  // Perspective; looks against `direction`, as near as the points, given as x, y, z each, stay whole in a
  // picture of this aspect with `margin` of its width and height free on every side: they touch two of its
  // borders.  Error::invalid_input if there are none.
  static Camera around(std::span<const float> points, const Eigen::Vector3f& direction, float fov_degree,
                       float aspect, float margin);

  // Orthographic from above (against gravity), x to the right, y up in the picture: Cusick's view.
  static Camera top(const Box& box, float aspect);

  Eigen::Matrix4f view() const;
  // Clip depth from -1 to 1.  `aspect`: of the whole picture; `window`: the part of it that fills clip space,
  // off centre unless it is the whole.
  Eigen::Matrix4f projection(float aspect, const Window& window = {}) const;
  // Whether all points, given as x, y, z each, lie within a picture of this aspect.
  bool frames(std::span<const float> positions, float aspect) const;
  // Box of the points' images, which may reach beyond the picture.  Error::invalid_input if there are none.
  Window image_window(std::span<const float> points, float aspect) const;
  const Eigen::Vector3f& eye() const { return eye_; }
  const Eigen::Vector3f& target() const { return target_; }
  float fov_degree() const;  // full vertical angle, of a perspective one
  Eigen::Vector3f forward() const { return (target_ - eye_).normalized(); }
  bool is_orthographic() const { return half_height_ > 0; }
  // Direction to a key light beside the camera: `azimuth` counted from the camera around gravity, to the left
  // of the picture, and `elevation` above the horizon [degree].
  Eigen::Vector3f beside(float azimuth, float elevation) const;
  // Length across the view that a pixel of a picture `height` pixels high shows, where clip space's w is 1
  // [m].
  float metres_per_pixel(int height) const;

  // Length at `point`, across the view, that one pixel of a picture `height` pixels high shows [m].
  float metres_per_pixel(const Eigen::Vector3f& point, int height) const;

 private:
  Eigen::Matrix4f centered_projection(float aspect) const;

  Eigen::Vector3f eye_{1, 0, 0}, target_{0, 0, 0}, up_{0, 0, 1};
  float tan_half_fov_ = 0.2f;
  float half_height_ = 0;  // > 0: orthographic [m]
  float near_ = 0.01f, far_ = 100.0f;
};

}  // namespace hysteron::render
