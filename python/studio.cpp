#include "python/studio.h"

#include "experiments/workbench/pictures/drawing.h"
#include "sim/base/error.h"
#include "sim/bending/vertex_curvature.h"

namespace hysteron::python {
namespace {

namespace pictures = experiments;

// One number a vertex, in looks that show one.
std::vector<float> shown_values(const std::string& look, const Cloth& cloth, Simulation& simulation) {
  const int d = simulation.dimension();
  if (look == "curvature") return vertex_curvature(cloth.mesh, simulation.curvature(), d);
  if (look == "residual") return vertex_curvature(cloth.mesh, simulation.residual_curvature(), d);
  if (look == "friction") return vertex_average(cloth.mesh, simulation.friction_share(), d);
  return {};
}

}  // namespace

Studio::Room& Studio::room(const Scene& scene, const Cloth& cloth, const PictureChoice& choice,
                           const render::Box& bounds, int cuda_device) {
  const std::string wanted = choice.options.size + " " + enum_name(choice.options.renderer);
  if (room_ && made_for_ == wanted) return *room_;
  room_.reset();
  mesh_ = pictures::drawn_mesh(cloth.mesh, scene.cloth);
  room_ = std::make_unique<Room>([&, options = choice.options] {
    return std::make_unique<pictures::SceneRenderer>(scene, options, mesh_, bounds, std::nullopt,
                                                     cuda_device);
  });
  made_for_ = wanted;
  return *room_;
}

render::Image Studio::picture(const Scene& scene, const Cloth& cloth, Simulation& simulation,
                              const PictureChoice& choice) {
  const std::string& name = choice.options.look;
  const std::vector<float> xyz = pictures::flat_points(simulation.positions());
  const render::Box bounds = choice.bounds.value_or(render::bounding_box(xyz));
  const render::Camera camera = pictures::framed_camera(choice.options, bounds);
  const pictures::SceneRenderer::Shown shown{simulation.time(), shown_values(name, cloth, simulation)};
  return room(scene, cloth, choice, bounds, simulation.cuda_device())
      .run([&](pictures::SceneRenderer& studio) {
        studio.view().set_bounds(bounds);
        studio.view().set_positions(xyz);
        render::Image image = studio.draw(pictures::scene_look(scene, choice.options, name), camera, shown);
        if (!studio.view().shows_cloth())
          throw Error::simulation("the picture shows no cloth: bounds must frame where it is");
        if (!choice.caption.empty())
          pictures::letter(image, camera, bounds.center(), choice.caption,
                           pictures::value_color_bar(scene, choice.options, name));
        return image;
      });
}

}  // namespace hysteron::python
