// Implements a simulation: a body on one device in one precision, and the integrator that moves it.
#pragma once

#include "sim/scene/motion.h"
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
  std::string save() override {
    Archive archive;
    serialise(archive);
    return archive.take();
  }
  void load(std::string_view state) override {
    Archive archive(state);
    serialise(archive);
    if (!archive.at_end()) throw Error::invalid_input("the state is of another simulation");
  }
  void wait() override { body_.device->synchronize(); }
  double time() const override {
    return static_cast<double>(body_.counts.steps) * body_.scene.step + extra_time_;
  }
  Diagnostics counts() const override {
    Diagnostics counts = body_.counts;
    counts.bytes = body_.device->bytes;
    return counts;
  }

  void drive(int number, const Eigen::Vector3d& velocity, double spin) override {
    pin(number);
    body_.pins.drive(body_, number, time(), velocity, spin);
  }
  Keyframe pin_displacement(int number) const override { return state_at(pin(number).motion, time()); }
  InPlace positions_in_place() const override { return is_shifted() ? InPlace{} : in_place(body_.x); }
  InPlace velocities_in_place() const override { return in_place(body_.v); }
  std::vector<Eigen::Vector3d> positions() override;
  std::vector<Eigen::Vector3d> velocities() override { return cast_to<double>(body_.v.download()); }
  std::vector<double> curvature() override { return body_.bending.curvature(); }
  std::vector<double> moment() override { return body_.bending.moment(); }
  std::vector<double> residual_curvature() override { return body_.bending.residual_curvature(); }
  std::vector<double> friction_share() override { return body_.bending.slip(); }
  std::vector<double> metric() const override { return body_.bending.metric(); }
  std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                               std::string& reason) override;
  std::vector<Eigen::Vector3d> pin_forces() override { return cast_to<double>(integrator_->pin_forces()); }
  Ledger ledger() override { return body_.balance(); }
  double largest_stretch() override { return body_.membrane.largest_stretch(body_.x.data()); }
  std::uint64_t state_hash() override;

  std::vector<std::pair<std::string, double>> stage_seconds() override;
  std::vector<ScenePart> parts() const override;
  double copy_bandwidth() override;
  void profile() override { body_.device->profile = std::make_unique<KernelProfile<Device>>(*body_.device); }
  KernelCosts kernel_costs() override {
    return body_.device->profile ? body_.device->profile->costs() : KernelCosts{};
  }
  double launch_seconds() override;

 private:
  void serialise(Archive& archive) {
    archive(extra_time_);
    body_.serialise(archive);
    integrator_->serialise(archive);
  }
  bool is_shifted() const { return !body_.origin.isZero(0); }  // positions are relative to a shifted origin
  const Pin& pin(int number) const;
  static InPlace in_place(const Buffer<Vec3<Real>, Device>& buffer);

  Body<Real, Device> body_;
  std::unique_ptr<TimeIntegrator<Real, Device>> integrator_;
  double extra_time_ = 0;  // excess of steps of other lengths over the scene's [s]
};

}  // namespace hysteron
