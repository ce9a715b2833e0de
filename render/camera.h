// The camera of a picture: viewpoint and projection.  World coordinates are in metres with z up.
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

// Returns the bounding box of points given as x, y, z each.  Error::invalid_input if there are none or one is
// not finite.
Box bounding_box(std::span<const float> positions);

// A rectangle of a picture, in fractions of its width and height from its lower left corner; it may reach
// beyond.
struct Window {
  double left = 0, bottom = 0, right = 1, top = 1;
};

class Camera {
 public:
  // `fov_degree` is the full vertical field of view.
  static Camera perspective(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fov_degree);

  // A perspective camera that looks at the box against `direction` (from the box to the eye), as near as the
  // box stays whole in a picture of this aspect (width / height).  A sequence passes the box of all its
  // frames.
  static Camera framing(const Box& box, const Eigen::Vector3f& direction, float fov_degree, float aspect);

  // A perspective camera that looks against `direction`, as near as the points (x, y, z each) stay whole in a
  // picture of this aspect with `margin` of its width and height free on every side; they touch two of the
  // margins. Error::invalid_input if there are none.
  static Camera around(std::span<const float> points, const Eigen::Vector3f& direction, float fov_degree,
                       float aspect, float margin);

  // An orthographic camera that looks down, x to the right and y up in the picture: Cusick's view.
  static Camera top(const Box& box, float aspect);

  Eigen::Matrix4f view() const;
  // The clip depth runs from -1 to 1.  `aspect` is that of the whole picture; `window` is the part of it that
  // fills clip space, off centre unless it is the whole.
  Eigen::Matrix4f projection(float aspect, const Window& window = {}) const;
  // Returns true if all points, given as x, y, z each, lie within a picture of this aspect.
  bool frames(std::span<const float> positions, float aspect) const;
  // Returns the box of the projected points, which may reach beyond the picture.  Error::invalid_input if
  // there are none.
  Window image_window(std::span<const float> points, float aspect) const;
  const Eigen::Vector3f& eye() const { return eye_; }
  const Eigen::Vector3f& target() const { return target_; }
  float fov_degree() const;  // full vertical field of view of a perspective camera
  Eigen::Vector3f forward() const { return (target_ - eye_).normalized(); }
  bool is_orthographic() const { return half_height_ > 0; }
  // Returns the direction to a key light beside the camera: `azimuth` is counted around the vertical from the
  // camera to the left of the picture, `elevation` above the horizon [degree].
  Eigen::Vector3f beside(float azimuth, float elevation) const;
  // Returns the length across the view per pixel of a picture `height` pixels high, where clip space's w is 1
  // [m].
  float metres_per_pixel(int height) const;

  // Returns the length across the view at `point` per pixel of a picture `height` pixels high [m].
  float metres_per_pixel(const Eigen::Vector3f& point, int height) const;

 private:
  Eigen::Matrix4f centered_projection(float aspect) const;

  Eigen::Vector3f eye_{1, 0, 0}, target_{0, 0, 0}, up_{0, 0, 1};
  float tan_half_fov_ = 0.2f;
  float half_height_ = 0;  // half the height seen by an orthographic camera [m]; 0: perspective
  float near_ = 0.01f, far_ = 100.0f;
};

}  // namespace hysteron::render
