// Sets up camera, light and text for pictures of runs and of files alike.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/options.h"
#include "render/camera.h"
#include "render/caption.h"
#include "render/look.h"
#include "render/picture_parts.h"

namespace hysteron::experiments {

// Returns the size and quality of the options' pictures.
render::PictureSize picture_size(const Options& options);
// Returns width over height.
float picture_aspect(const Options& options);
// Returns the options' camera, as near as `bounds`, or the options' box, is entirely visible, unless they
// give a distance.
render::Camera framed_camera(const Options& options, const render::Box& bounds);
// Returns the look in the options' light, "studio" or "raking", before their background is applied.
render::Look apply_lighting(render::Look look, const Options& options);

// Draws caption, scale bar (valid at `middle`) and, if there is one, colour bar.
void annotate(render::Image& image, const render::Camera& camera, const Eigen::Vector3f& middle,
              const std::string& caption, const std::optional<render::ColorBar>& bar);

// Convert triangles and points to the renderer's flat arrays.
std::vector<int> flat_triangles(const std::vector<Eigen::Vector3i>& face);
std::vector<float> flat_points(const std::vector<Eigen::Vector3d>& points);

}  // namespace hysteron::experiments
