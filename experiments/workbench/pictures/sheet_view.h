// Where the pictures of a contact sheet are seen from: all from one place, and what is small there once more
// from nearer by.
#pragma once

#include <optional>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pictures/archived_instants.h"
#include "render/camera.h"

namespace hysteron::experiments {

// The camera, shape and scale of every cell of a contact sheet.
struct SheetView {
  render::Camera camera;
  float aspect;             // width over height
  int width, height;        // [pixels]
  double metres_per_pixel;  // in the middle of the last instant's cloth
};

// Returns a view as near as all of at least one instants are entirely visible, whose aspect is that of their
// contents, unless the options set the view: then that of the sequence, which frames `bounds`.
SheetView sheet_view(const std::vector<ArchivedInstant>& instants, const Options& options,
                     const render::Box& bounds);

struct NearerView {
  render::Camera camera;
  float enlargement;  // over the other cells, a multiple of 0.1
};
// Returns the view of a perspective camera, whose pictures have `metres_per_pixel`, from as far as shows
// everything `enlargement` times as large as the other cells do.
NearerView nearer(const render::Camera& camera, double metres_per_pixel, double enlargement,
                  const SheetView& view);
// Returns a view in which the cloth of one instant, `xyz`, fills a cell; nothing if it fills most of one
// already, or if the options set the view.
std::optional<NearerView> nearer_view(const std::vector<float>& xyz, const SheetView& view,
                                      const Options& options);

// Returns a view of one instant's cloth from another direction, at most as near as the other cells'.
render::Camera further_view(const std::vector<float>& xyz, const Eigen::Vector3f& direction,
                            const SheetView& view, const Options& options);

}  // namespace hysteron::experiments
