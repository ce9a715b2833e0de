// A simulation for Python, with its scene and cloth, for one thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "experiments/workbench/pictures/frame_source.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "python/values.h"
#include "sim/base/own_thread.h"
#include "sim/time/simulation.h"

namespace hysteron::python {

// The contents of a picture, beside the simulation.
struct PictureChoice {
  experiments::Options options;
  std::optional<render::Box> bounds;  // framed box [m]; none: the cloth's
  std::string caption;                // with scale and colour bar; "": no text at all
};

class SimulationValue {
 public:
  // Checks the scene and builds the cloth.
  explicit SimulationValue(const Scene& scene);

  // Steps without the interpreter's lock.  Between steps it checks for signals, and KeyboardInterrupt stops
  // early: the steps taken so far are kept.
  void advance(int steps);

  const Scene& scene() const { return scene_; }
  const Cloth& cloth() const { return cloth_; }
  // Throws Error::invalid_input while another thread steps or draws it.
  Simulation& at_rest() const;
  // Throws Error::system if there is no OpenGL context (pictures.cpp).
  render::Image picture(const PictureChoice& choice);

 private:
  // Returns the thread that owns the OpenGL context, kept from one picture to the next.
  using Studio = OwnThread<experiments::SceneRenderer>;
  Studio& studio(const PictureChoice& choice, const render::Box& bounds, int cuda_device);
  render::Image drawn(const PictureChoice& choice, Simulation& simulation);

  // Calls body(simulation) without the interpreter's lock, while no other thread may use the simulation.
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
  bool in_use_ = false;          // a thread uses it without the interpreter's lock, which guards this
  experiments::DrawnMesh mesh_;  // mesh of the studio
  std::unique_ptr<Studio> studio_;
  experiments::Options made_for_;  // the studio's size and renderer, fixed at its creation
};

}  // namespace hysteron::python
