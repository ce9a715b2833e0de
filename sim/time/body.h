// Holds the cloth on one device in one precision: its state, its forces, and its pins, whichever integrator
// moves it.
#pragma once

#include <memory>
#include <optional>

#include "sim/bending/bending.h"
#include "sim/contact/contact.h"
#include "sim/contact/self_contact.h"
#include "sim/device/stage_clock.h"
#include "sim/membrane/membrane.h"
#include "sim/time/diagnostics.h"
#include "sim/time/ledger.h"
#include "sim/time/pins.h"

namespace hysteron {

template <class To, class From>
std::vector<Vec3<To>> cast_to(const std::vector<Vec3<From>>& values) {
  std::vector<Vec3<To>> result;
  for (const auto& v : values) result.push_back(v.template cast<To>());
  return result;
}

template <class Real, class Device>
struct Body {
  Body(std::unique_ptr<Device> device, const Scene& scene, const Cloth& cloth, const CurvatureOperator& op);

  std::unique_ptr<Device> device;
  // The origin is in the world [m]; positions here and in scene and cloth are relative to it (cloth.h).
  Eigen::Vector3d origin;
  Scene scene;
  Cloth cloth;
  int vertices;
  StageClock<Device> clock;
  BlockRows<Real, Device> matrix;
  Membrane<Real, Device> membrane;
  Bending<Real, Device> bending;
  std::optional<Contact<Real, Device>> contact;
  std::optional<SelfContact<Real, Device>> self_contact;
  Buffer<Vec3<Real>, Device> x, v;    // [m], [m/s]; a held vertex has the coming stage's v
  Buffer<Vec3<Real>, Device> before;  // x at the start of a stage [m]; with contact only
  Buffer<Real, Device> mass;          // [kg]
  Buffer<char, Device> held;
  Buffer<VertexLedger, Device> ledger;
  Pins<Real, Device> pins;
  Diagnostics counts;
  long last_pinched = -1, last_deep = -1;  // the parts that were counted so last (pinch.h)
  // True if pins, obstacles or commands have changed forces at once since the stage accepted last.
  bool forces_discontinuous = false;

  // Begins a stage from `start` over h [s]: moves pins and obstacles and saves positions.
  void begin_stage(double start, Real h);
  // Accepts the positions at the end of a stage into contact's history.
  void end_stage(double time);
  // Attaches, releases and moves what is due of pins and obstacles.
  void apply_due_events(double start, Real h);
  // Carries out commands that are due in a step, on the state accepted last.
  void carry_out_commands(double start, double end);

  Vec3<Real> gravity() const { return scene.gravity.template cast<Real>(); }              // [m/s^2]
  Real drag() const { return static_cast<Real>(scene.air_drag / scene.fabric.density); }  // over mass [1/s]

  // Saves or loads the state that outlives a step; the rest follows from the scene, or is made anew in every
  // step.
  void serialise(Archive& archive);

  Ledger energies();  // at present
  Ledger balance();   // since the start
  std::size_t state_bytes() const { return x.bytes() + v.bytes() + mass.bytes() + held.bytes(); }
  bool is_finite();

 private:
  Ledger initial_;
  double next_obstacle_ = 0, met_ = -1;          // when an obstacle appears next, and did last [s]
  std::vector<Eigen::Vector3d> command_center_;  // middles of bending elements on the flat cloth; if needed
  Buffer<double, Device> size_;                  // sum of squares of the state
};

}  // namespace hysteron
