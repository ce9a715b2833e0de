#include "experiments/workbench/pictures/drawing.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace hysteron::experiments {
namespace {

constexpr int kShownWidth = 640;      // width of a picture on a page [pixels]
constexpr float kRakingRoom = 0.45f;  // raking light is in a dim room

render::Box framed_box(const Options& options, render::Box box) {
  if (!options.camera_box.empty()) {
    const Eigen::Map<const Eigen::Vector3d> low(options.camera_box.data()), high(low.data() + 3);
    box = {low.cast<float>(), high.cast<float>()};
  }
  if (options.camera_target.empty()) return box;
  // Extends the box to every side of the target as far as it reaches from it on either.
  const Eigen::Vector3f target =
      Eigen::Map<const Eigen::Vector3d>(options.camera_target.data()).cast<float>();
  const Eigen::Vector3f reach = (box.high - target).cwiseAbs().cwiseMax((target - box.low).cwiseAbs());
  return {target - reach, target + reach};
}

}  // namespace

render::PictureSize picture_size(const Options& options) {
  constexpr int kDraftSamples = 4;   // samples drawn at once
  constexpr int kFigurePasses = 16;  // passes with 192 directions of light
  render::PictureSize size{options.width(), options.height()};
  if (options.quality == PictureQuality::draft) size.samples = kDraftSamples;
  if (options.quality == PictureQuality::figure) size.figure_passes = kFigurePasses;
  return size;
}

float picture_aspect(const Options& options) {
  return static_cast<float>(options.width()) / static_cast<float>(options.height());
}

render::Camera framed_camera(const Options& options, const render::Box& bounds) {
  const Eigen::Vector3f direction = options.camera_direction.cast<float>();
  const float fov = static_cast<float>(options.camera_fov);
  const render::Box box = framed_box(options, bounds);
  if (options.camera_distance == 0)
    return render::Camera::framing(box, direction, fov, picture_aspect(options));
  const Eigen::Vector3f eye =
      box.center() + static_cast<float>(options.camera_distance) * direction.normalized();
  return render::Camera::perspective(eye, box.center(), fov);
}

render::Look apply_lighting(render::Look look, const Options& options) {
  look.background = options.background;
  look.shown = std::min(1.0f, static_cast<float>(kShownWidth) / static_cast<float>(options.width()));
  look.raking = options.light == Lighting::raking;
  if (look.raking) look.room = kRakingRoom;
  return look;
}

void annotate(render::Image& image, const render::Camera& camera, const Eigen::Vector3f& middle,
              const std::string& caption, const std::optional<render::ColorBar>& bar) {
  render::draw_caption(image, caption, render::Corner::top_left);
  render::draw_scale_bar(image, camera.metres_per_pixel(middle, image.height()), render::Corner::bottom_left,
                         "at the cloth's middle");
  if (bar) render::draw_color_bar(image, *bar, render::Corner::bottom_right);
}

std::vector<int> flat_triangles(const std::vector<Eigen::Vector3i>& face) {
  std::vector<int> corners;
  corners.reserve(3 * face.size());
  for (const Eigen::Vector3i& f : face) corners.insert(corners.end(), {f[0], f[1], f[2]});
  return corners;
}

std::vector<float> flat_points(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> xyz;
  xyz.reserve(3 * points.size());
  for (const auto& p : points)
    for (int k = 0; k < 3; ++k) xyz.push_back(static_cast<float>(p[k]));
  return xyz;
}

}  // namespace hysteron::experiments
