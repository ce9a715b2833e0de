#include "experiments/workbench/pictures/sheet_view.h"

#include <algorithm>
#include <cmath>

#include "experiments/workbench/pictures/drawing.h"

namespace hysteron::experiments {
namespace {

constexpr double kCellPixels = 560 * 420;         // pixels drawn for each cell
constexpr float kMargin = 0.06f;                  // margin around a cell's contents on either side
constexpr float kTallest = 0.4f, kWidest = 2.4f;  // least and largest aspect of a cell
constexpr double kWorthwhile = 1.75;              // least enlargement of a picture from nearer by

render::Camera camera_from(const Eigen::Vector3f& direction, const std::vector<float>& xyz, float aspect,
                           const Options& options) {
  return render::Camera::around(xyz, direction, static_cast<float>(options.camera_fov), aspect, kMargin);
}

render::Camera camera_around(const std::vector<float>& xyz, float aspect, const Options& options) {
  return camera_from(options.camera_direction.cast<float>(), xyz, aspect, options);
}

bool sets_view(const Options& options) {
  return !options.camera_box.empty() || !options.camera_target.empty() || options.camera_distance > 0;
}

double scale_at(const std::vector<float>& xyz, const render::Camera& camera, int height) {
  return camera.metres_per_pixel(render::bounding_box(xyz).center(), height);
}

SheetView view_of(const render::Camera& camera, float aspect, const std::vector<float>& last) {
  const int width = static_cast<int>(std::lround(std::sqrt(kCellPixels * aspect))),
            height = static_cast<int>(std::lround(static_cast<float>(width) / aspect));
  return {camera, aspect, width, height, scale_at(last, camera, height)};
}

}  // namespace

SheetView sheet_view(const std::vector<ArchivedInstant>& instants, const Options& options,
                     const render::Box& bounds) {
  const std::vector<float>& last = instants.back().xyz;
  if (sets_view(options)) return view_of(framed_camera(options, bounds), picture_aspect(options), last);
  std::vector<float> all;
  for (const ArchivedInstant& instant : instants)
    all.insert(all.end(), instant.xyz.begin(), instant.xyz.end());
  const render::Window square = camera_around(all, 1, options).image_window(all, 1);
  const float aspect = std::clamp(
      static_cast<float>((square.right - square.left) / (square.top - square.bottom)), kTallest, kWidest);
  return view_of(camera_around(all, aspect, options), aspect, last);
}

std::optional<NearerView> nearer_view(const std::vector<float>& xyz, const SheetView& view,
                                      const Options& options) {
  if (sets_view(options)) return std::nullopt;
  const render::Camera own = camera_around(xyz, view.aspect, options);
  const double nearest = scale_at(xyz, own, view.height);
  const double enlargement = std::floor(10 * view.metres_per_pixel / nearest) / 10;
  if (enlargement < kWorthwhile) return std::nullopt;
  return nearer(own, nearest, enlargement, view);
}

NearerView nearer(const render::Camera& camera, double metres_per_pixel, double enlargement,
                  const SheetView& view) {
  const auto back = static_cast<float>(view.metres_per_pixel / enlargement / metres_per_pixel);
  return {render::Camera::perspective(camera.target() + back * (camera.eye() - camera.target()),
                                      camera.target(), camera.fov_degree()),
          static_cast<float>(enlargement)};
}

render::Camera further_view(const std::vector<float>& xyz, const Eigen::Vector3f& direction,
                            const SheetView& view, const Options& options) {
  const render::Camera near = camera_from(direction, xyz, view.aspect, options);
  const float distance =
      std::max((near.eye() - near.target()).norm(), (view.camera.eye() - view.camera.target()).norm());
  return render::Camera::perspective(near.target() + distance * direction.normalized(), near.target(),
                                     static_cast<float>(options.camera_fov));
}

}  // namespace hysteron::experiments
