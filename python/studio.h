// Where a simulation is pictured: a thread that has the OpenGL context, kept from one picture to the next.
#pragma once

#include <optional>
#include <string>

#include "experiments/workbench/pictures/scene_renderer.h"
#include "experiments/workbench/pictures/subject.h"
#include "sim/base/own_thread.h"
#include "sim/time/simulation.h"

namespace hysteron::python {

// What a picture is of, beside the simulation.
struct PictureChoice {
  experiments::Options options;
  std::optional<render::Box> bounds;  // framed [m]; none: the cloth as it is
  std::string caption;                // with scale and colour bar; "": none of these letters
};

class Studio {
 public:
  // Error::system where no context is to be had.
  render::Image picture(const Scene& scene, const Cloth& cloth, Simulation& simulation,
                        const PictureChoice& choice);

 private:
  using Room = OwnThread<experiments::SceneRenderer>;
  Room& room(const Scene& scene, const Cloth& cloth, const PictureChoice& choice, const render::Box& bounds,
             int cuda_device);

  experiments::DrawnMesh mesh_;  // of the room
  std::unique_ptr<Room> room_;
  std::string made_for_;  // size and renderer, which a room has for good
};

}  // namespace hysteron::python
