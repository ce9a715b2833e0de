// What pictures of runs and pictures of files have in common: camera, light and letters.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/options.h"
#include "render/camera.h"
#include "render/caption.h"
#include "render/cloth_view.h"
#include "render/look.h"

namespace hysteron::experiments {

// The options' size and quality.
render::PictureSize picture_size(const Options& options);
// Width over height.
float picture_aspect(const Options& options);
// The options' camera: as near as `bounds`, or the options' box, stays whole, unless they give a distance.
render::Camera framed_camera(const Options& options, const render::Box& bounds);
// The look in the options' light, "studio" or "raking", before their background.
render::Look lit(render::Look look, const Options& options);

// Caption, scale bar (it holds at `middle`) and, where there is one, colour bar.
void letter(render::Image& image, const render::Camera& camera, const Eigen::Vector3f& middle,
            const std::string& caption, const std::optional<render::ColorBar>& bar);

// Triangles and points as the renderer takes them.
std::vector<int> flat_triangles(const std::vector<Eigen::Vector3i>& face);
std::vector<float> flat_points(const std::vector<Eigen::Vector3d>& points);

}  // namespace hysteron::experiments
