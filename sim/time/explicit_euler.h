// `explicit`: symplectic Euler, every force explicit.
#pragma once

#include "sim/time/time_integrator.h"

namespace hysteron {

template <class Real, class Device>
class ExplicitEuler : public TimeIntegrator<Real, Device> {
 public:
  ExplicitEuler(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start) override;
  void step_by(double, double) override { refuse_long_step(body_.scene); }
  void become_static() override { refuse_statics(body_.scene); }
  void visit(Archive&) override {}  // forces are those of each substep's start
  std::size_t bytes() const override { return force_.bytes(); }

  void substep(Real dt);  // public because nvcc allows no device lambda in a private member function

 private:
  Body<Real, Device>& body_;
  int substeps_;
  Buffer<Vec3<Real>, Device> force_;  // of membrane and contact [N]
};

}  // namespace hysteron
