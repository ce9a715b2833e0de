// Takes steps that Newton's method solves: `implicit`, `bdf2`, `tr-bdf2` and `quasi-static`, with every force
// at the end of the step or stage; and `semi-implicit` with self-contact, whose bending lags.
#pragma once

#include "sim/time/implicit_step.h"
#include "sim/time/time_integrator.h"

namespace hysteron {

// Solves once for the whole step, in halves where that fails, or in as many parts as the scene's tolerance
// asks for.
template <class Real, class Device>
class ImplicitIntegrator : public TimeIntegrator<Real, Device> {
 public:
  ImplicitIntegrator(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start, double h) override;
  void become_static() override {
    if (bending_lags()) return TimeIntegrator<Real, Device>::become_static();
    solver_.become_static();
    tolerance_ = 0;  // the tolerance is for steps in time
  }
  std::vector<Vec3<Real>> pin_forces() override { return solver_.pin_forces(); }
  void serialise(Archive& archive) override {
    archive(part_, tolerance_);
    solver_.serialise(archive);
  }
  std::size_t bytes() const override { return solver_.bytes(); }

 private:
  using TimeIntegrator<Real, Device>::body_;
  bool bending_lags() const { return body_.scene.integrator == Integrator::semi_implicit; }
  void take_lagged_step(double start, double whole);
  // Goes from start to start + h, in halves if it does not converge.
  void take_interval(double start, double h, int halvings);
  void take_adaptive_step(double start, double whole);
  void finish(double start, double h, int halvings);
  void take_halves(double start, double h, int halvings, const NewtonOutcome& outcome);
  bool stiffen_parallel_edges();
  double first_stage(double h) const { return solver_.has_two_stages() ? kTrapezoidalFraction * h : h; }
  NewtonOutcome attempt(double start, double h, bool is_first_stage, bool is_last_resort);
  NewtonOutcome solve(double start, double h, bool is_first_stage);
  void accept(double end);
  double load_fraction(double time) const;

  ImplicitStep<Real, Device> solver_;
  int substeps_;                // of lagged bending
  double tolerance_;            // [m]; 0: steps are not divided
  NewtonOutcome last_outcome_;  // outcome of the last attempt
  double part_ = 0;             // the next part of an adaptive step [s]
};

}  // namespace hysteron
