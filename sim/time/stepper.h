// A simulation: a body on one device in one precision, and the integrator that moves it.
#pragma once

#include "sim/time/time_integrator.h"

namespace hysteron {

template <class Real, class Device>
class Stepper : public Simulation {
 public:
  Stepper(std::unique_ptr<Device> device, const Scene& scene, const Cloth& cloth, const CurvatureOperator& op,
          const StepLimits& limits);

  void advance(int steps) override;
  void advance_by(double seconds) override;
  void become_static() override { integrator_->become_static(); }
  std::string save() override;
  void load(std::string_view state) override;
  void wait() override { body_.device->synchronize(); }
  double time() const override { return static_cast<double>(steps_) * body_.scene.step + beyond_; }
  long steps() const override { return steps_; }

  void drive(int pin, const Eigen::Vector3d& velocity, double spin) override;
  Keyframe hand(int pin) const override;
  InPlace positions_in_place() const override { return is_shifted() ? InPlace{} : in_place(body_.x); }
  InPlace velocities_in_place() const override { return in_place(body_.v); }
  std::vector<Eigen::Vector3d> positions() override;
  std::vector<Eigen::Vector3d> velocities() override;
  std::vector<double> curvature() override { return body_.bending.curvature(); }
  std::vector<double> moment() override { return body_.bending.moment(); }
  std::vector<double> residual_curvature() override { return body_.bending.residual_curvature(); }
  std::vector<double> friction_share() override { return body_.bending.slip(); }
  int dimension() const override { return body_.bending.dimension(); }
  std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                               std::string& reason) override;
  std::vector<Eigen::Vector3d> handle_forces() override;
  Ledger ledger() override { return body_.balance(); }
  double largest_stretch() override { return body_.membrane.largest_stretch(body_.x.data()); }
  std::uint64_t state_hash() override;

  std::vector<std::pair<std::string, double>> stage_seconds() override;
  double solver_iterations() const override { return per_step(body_.counts.linear); }
  double newton_iterations() const override { return per_step(body_.counts.newton); }
  long parts_taken() const override { return body_.counts.parts; }
  long retried_steps() const override { return body_.counts.retried; }
  long unbalanced_steps() const override { return body_.counts.unbalanced; }
  long deep_steps() const override { return body_.counts.deep; }
  long slack_hand_steps() const override { return body_.hands.slack_stages(); }
  long barred_hand_steps() const override { return body_.hands.barred_stages(); }
  double hand_lag() const override { return body_.hands.largest_lag(); }
  SolverCounts solver_counts() const override {
    const StepCounts& c = body_.counts;
    const double mean = c.stages > 0 ? c.velocities / static_cast<double>(c.stages) : 0;
    return {c.newton,        c.linear,           c.unbalanced,       c.retried, c.time_steps,
            c.last_residual, c.largest_residual, c.largest_velocity, mean};
  }
  StepLimits limits() const override { return limits_; }
  std::vector<ScenePart> parts() const override;
  std::size_t device_bytes() const override { return body_.device->bytes; }
  DeviceCounts device_work() const override { return body_.counts.device; }
  double copy_bandwidth() override;
  void profile() override;
  KernelCosts kernel_costs() override;
  double launch_seconds() override;
  std::string device() const override;
  int cuda_device() const override { return body_.device->cuda_device(); }

 private:
  void visit(Archive& archive);
  bool is_shifted() const { return !body_.origin.isZero(0); }  // positions are not the world's
  const Pin& pin(int number) const;
  static InPlace in_place(const Buffer<Vec3<Real>, Device>& buffer);
  double per_step(long count) const {
    return steps_ ? static_cast<double>(count) / static_cast<double>(steps_) : 0;
  }

  Body<Real, Device> body_;
  StepLimits limits_;
  std::unique_ptr<TimeIntegrator<Real, Device>> integrator_;
  long steps_ = 0;
  double beyond_ = 0;  // by which steps of other lengths have exceeded the scene's [s]
};

}  // namespace hysteron
