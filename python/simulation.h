// A simulation as Python has it: with its scene and cloth, for one thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "experiments/workbench/pictures/scene_renderer.h"
#include "experiments/workbench/pictures/subject.h"
#include "python/values.h"
#include "sim/base/own_thread.h"
#include "sim/time/simulation.h"

namespace hysteron::python {

// What a picture is of, beside the simulation.
struct PictureChoice {
  experiments::Options options;
  std::optional<render::Box> bounds;  // framed [m]; none: the cloth as it is
  std::string caption;                // with scale and colour bar; "": none of these letters
};

class SimulationValue {
 public:
  // Checks the scene and builds the cloth.
  explicit SimulationValue(const Scene& scene);

  // Steps without the interpreter's lock; between them signals are looked for, and KeyboardInterrupt ends
  // them early: the steps that were taken stay.
  void advance(int steps);

  const Scene& scene() const { return scene_; }
  const Cloth& cloth() const { return cloth_; }
  // Error::invalid_input while another thread steps or draws it.
  Simulation& at_rest() const;
  // Error::system where no OpenGL context is to be had (pictures.cpp).
  render::Image picture(const PictureChoice& choice);

 private:
  // Where it is pictured: a thread that has the OpenGL context, kept from one picture to the next.
  using Studio = OwnThread<experiments::SceneRenderer>;
  Studio& studio(const PictureChoice& choice, const render::Box& bounds, int cuda_device);
  render::Image drawn(const PictureChoice& choice, Simulation& simulation);

  // body(simulation) without the interpreter's lock, while no other thread may use the simulation.
  template <class Body>
  void alone(const Body& body) {
    Simulation& simulation = at_rest();
    struct Use {
      bool& flag;
      explicit Use(bool& in_use) : flag(in_use) { flag = true; }
      ~Use() { flag = false; }
    } const use(in_use_);
    unlocked([&] { body(simulation); });
  }

  Scene scene_;
  Cloth cloth_;
  std::unique_ptr<Simulation> simulation_;
  bool in_use_ = false;          // by a thread without the interpreter's lock, which guards it
  experiments::DrawnMesh mesh_;  // of the studio
  std::unique_ptr<Studio> studio_;
  experiments::Options made_for_;  // whose size and renderer a studio has for good
};

}  // namespace hysteron::python
