// A simulation as Python has it: with its scene and cloth, for one thread at a time.
#pragma once

#include <memory>
#include <string>

#include "python/studio.h"
#include "python/values.h"
#include "sim/time/simulation.h"

namespace hysteron::python {

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
  render::Image picture(const PictureChoice& choice);

 private:
  // body(simulation) without the interpreter's lock, while no other thread may use the simulation.
  template <class Body>
  void alone(const Body& body);

  Scene scene_;
  Cloth cloth_;
  std::unique_ptr<Simulation> simulation_;
  bool in_use_ = false;  // by a thread without the interpreter's lock, which guards it
  Studio studio_;
};

}  // namespace hysteron::python
