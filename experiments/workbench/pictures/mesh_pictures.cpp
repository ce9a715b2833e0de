#include "experiments/workbench/pictures/mesh_pictures.h"

#include <cmath>

#include "experiments/workbench/pictures/fabric_look.h"
#include "experiments/workbench/pictures/frame_source.h"
#include "sim/base/error.h"
#include "sim/base/root_mean_square.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/mesh/mesh_sequence.h"

namespace hysteron::experiments {
namespace {

render::Look mesh_look(const Options& options, const MeshPictures::Choice& choice) {
  render::Look look = render::look_named(options.look);
  if (look.show == render::Show::curvature) {
    look.value_high = static_cast<float>(choice.range);
    look.value_low = -look.value_high;
  }
  look = apply_lighting(look, options);
  return choice.fabric.empty() ? look : apply_fabric_look(look, choice.fabric);
}

}  // namespace

MeshPictures::MeshPictures(const Options& options, const Choice& choice)
    : options_(options),
      choice_(choice),
      look_(mesh_look(options, choice)),
      offscreen_(render::Offscreen::create(options.renderer)),
      view_(*offscreen_, picture_size(options)) {
  view_.set_look(look_);
  view_.set_ground(choice.ground);
  view_.set_bounds(choice.bounds);
}

void MeshPictures::add_body(const Surface& body) {
  view_.add_obstacle(render::smooth_mesh(body.vertex, body.face), Eigen::Matrix4f::Identity());
}

render::Image MeshPictures::picture(const Surface& frame, const std::string& what) {
  if (frame.face != face_ || frame.vertex.size() != vertices_) {
    face_ = frame.face;
    vertices_ = frame.vertex.size();
    view_.set_cloth({vertices_, flat_triangles(face_), thread_coordinates(frame)});
  }
  view_.set_positions(flat_points(frame.vertex));
  if (look_.show == render::Show::curvature) {
    if (choice_.stored_curvature)
      curvature_.assign(frame.curvature.begin(), frame.curvature.end());
    else
      curvature_ = surface_curvature(frame.vertex, frame.face, what);
    area_ = vertex_areas(flat_triangles(face_), flat_points(frame.vertex));
    view_.set_values(curvature_);
  }
  render::Image image = view_.draw(camera());
  if (!view_.shows_cloth()) throw Error::simulation(what + " is not in its picture: frame where it is");
  return image;
}

void MeshPictures::letter_picture(render::Image& image, const std::string& caption) const {
  annotate(image, camera(), choice_.bounds.center(), caption, color_bar());
}

double MeshPictures::metres_per_pixel() const {
  return camera().metres_per_pixel(choice_.bounds.center(), options_.height());
}

std::optional<render::ColorBar> MeshPictures::color_bar() const {
  if (look_.show != render::Show::curvature) return {};
  return render::ColorBar{look_.map, look_.value_low, look_.value_high, "curvature", "1/m"};
}

std::optional<double> MeshPictures::curvature_rms() const {
  if (curvature_.empty()) return {};
  return root_mean_square(curvature_, area_);
}

}  // namespace hysteron::experiments
