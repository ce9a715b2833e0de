// The simulation on one device in one precision.  stepper.cpp sets it up and measures, semi_implicit.cpp and
// implicit_interval.cpp step, refusals.cpp says why a run cannot go on.
#pragma once

#include <optional>

#include "sim/bending/bending.h"
#include "sim/contact/contact.h"
#include "sim/contact/self_contact.h"
#include "sim/device/stage_clock.h"
#include "sim/linear/pcg.h"
#include "sim/membrane/membrane.h"
#include "sim/scene/motion.h"
#include "sim/time/back_end.h"
#include "sim/time/implicit_step.h"
#include "sim/time/simulation.h"

namespace hysteron {

template <class Real>
struct PinPlacements {
  Mat3<Real> rotation[kMostMovingPins];
  Vec3<Real> translation[kMostMovingPins];
  // Share of the way home that is done at the end of the step, and in it.
  Real home[kMostMovingPins], homewards[kMostMovingPins];
  // The way of a step as one screw: the pin turns by `turn` about a pivot that moves by `shift`.
  Vec3<Real> turn[kMostMovingPins], pivot[kMostMovingPins], shift[kMostMovingPins];  // [rad], at the end [m]
};

template <class Real, class Device>
class Stepper : public Simulation {
 public:
  Stepper(std::unique_ptr<Device> device, const Scene& scene, const Cloth& cloth, const CurvatureOperator& op,
          const StepLimits& limits);

  void advance(int steps) override;
  void wait() override { device_->synchronize(); }
  double copy_bandwidth() override;
  double time() const override { return static_cast<double>(step_count_) * scene_.step; }
  long steps() const override { return step_count_; }
  std::vector<Eigen::Vector3d> positions() override;
  std::vector<Eigen::Vector3d> velocities() override;
  std::vector<double> curvature() override { return bending_.curvature(); }
  std::vector<double> moment() override { return bending_.moment(); }
  std::vector<double> residual_curvature() override { return bending_.residual_curvature(); }
  std::vector<double> friction_share() override { return bending_.slip(); }
  int dimension() const override { return bending_.dimension(); }
  std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                               std::string& reason) override;
  void become_static() override;
  std::vector<Eigen::Vector3d> handle_forces() override;
  Ledger ledger() override;
  double largest_stretch() override { return membrane_.largest_stretch(x_.data()); }
  std::uint64_t state_hash() override;
  std::vector<std::pair<std::string, double>> stage_seconds() override;
  double solver_iterations() const override;
  double newton_iterations() const override;
  long parts_taken() const override { return substeps_taken_; }
  long retried_steps() const override { return retried_steps_; }
  long unbalanced_steps() const override { return unbalanced_steps_; }
  StepLimits limits() const override { return limits_; }
  std::vector<ScenePart> parts() const override;
  std::size_t device_bytes() const override { return device_->bytes; }
  std::string device() const override;
  int cuda_device() const override { return device_->cuda_device(); }
  long deep_steps() const override { return deep_steps_; }

  // The parts of advance(); public because nvcc allows no device lambda in a private member function.
  void carry_out_commands(double start, double end);  // commands that are due
  void stage(double start, Real h);                   // one implicit solve and what leads to it
  void self_contact_stage(double start, Real h);
  void update_pins(double time);  // pins take hold and let go
  void book_grip(const std::vector<char>& held);
  void capture_pins(const std::vector<int>& pins, double time);
  void hold(double start, Real h);  // pins: which vertices are held, and their velocity in this stage
  void gather_impulses(Real h);  // bending and external forces, for a stage in which all forces act together
  void substep(Real dt);         // bending and external forces, explicit
  void explicit_substep(Real dt);  // every force, explicit
  void implicit_stage(Real h);     // tension, damping and contact, implicit
  void linear_system(Real h, bool first);
  void accept_implicit(Real h);
  // An implicit step from start to start + h, in halves if it does not converge.
  void implicit_interval(double start, double h, int halvings);
  void adaptive_interval(double start);  // a step of the scene in parts that keep its tolerance
  void adaptive_stages(double start);    // the same for `semi-implicit`
  NewtonOutcome try_step(double start, double h);
  void take_step(double end);
  double change_size();
  void remember_positions();
  double load_share(double time) const;
  void commit_contact(double time);  // accepts positions at the end of a stage
  // Error::run (refusals.cpp, but the first): a position or velocity is no longer finite; an obstacle appears
  // where the cloth is; the cloth is crushed; a step has no solution.
  void refuse_divergence();
  void meet_obstacles(double time);
  void refuse_release(const std::vector<char>& before, const std::vector<char>& held, double time);
  void refuse_crushed(double time);
  void refuse_unbalanced(double start, double h, const NewtonOutcome& outcome);
  std::vector<std::string> pressing(int vertex, const Eigen::Vector3d& x, double time);

 private:
  void choose_substeps(const Cloth& cloth, const CurvatureOperator& op, const StepLimits& limits);
  Ledger measure();
  VertexState<Real> vertex_state() {
    return {x_.data(), v_.data(), held_.data(), mass_.data(), handle_way_.data()};
  }

  std::unique_ptr<Device> device_;
  Scene scene_;
  bool explicit_;
  bool all_implicit_;       // bending too
  bool with_self_contact_;  // semi-implicit with self-contact: an implicit step whose bending lags
  bool coupled_;  // all forces in one solve per substep; else the chapter's substeps and one solve per step
  int vertices_;
  long step_count_ = 0;
  double part_ = 0;  // of adaptive steps: the coming one [s]
  long substeps_taken_ = 0, newton_iterations_ = 0, solver_iterations_ = 0, retried_steps_ = 0,
       unbalanced_steps_ = 0, deep_steps_ = 0;
  StepLimits limits_;
  StageClock<Device> clock_;
  BlockRows<Real, Device> matrix_;
  Membrane<Real, Device> membrane_;
  Bending<Real, Device> bending_;
  Pcg<Real, Device> pcg_;
  std::optional<Contact<Real, Device>> contact_;
  std::optional<SelfContact<Real, Device>> self_contact_;
  std::unique_ptr<ImplicitStep<Real, Device>> implicit_;
  bool moving_pins_ = false;
  double next_grip_ = 0;                 // when pins take hold or let go next [s]
  double grip_work_ = 0;                 // done on the cloth by taking hold and letting go [J]
  std::vector<double> grip_times_;       // of all of them
  double next_obstacle_ = 0, met_ = -1;  // when an obstacle appears next, and did last [s]
  Cloth cloth_;
  std::vector<Eigen::Vector3d> command_center_;  // of each bending element on the flat cloth; if needed
  Buffer<Vec3<Real>, Device> x_, v_, start_, before_, rhs_;
  Buffer<Vec3<Real>, Device> home_;        // where vertices were at t = 0, if a pin brings them back there
  Buffer<Vec3<Real>, Device> handle_way_;  // of implicit steps with moving pins
  Buffer<Vec3<Real>, Device> impulse_;     // of the explicit forces over a stage [N s]
  Buffer<Vec3<Real>, Device> change_,
      correction_;  // dv of the implicit stage, and of its last Newton step [m/s]
  Buffer<Real, Device> mass_;
  Buffer<int, Device> pin_;
  Buffer<char, Device> held_;
  Buffer<VertexLedger, Device> ledger_;
  Buffer<double, Device> size_;  // sum of all squares of the state, to see whether it is finite
  Ledger initial_;
};

}  // namespace hysteron
