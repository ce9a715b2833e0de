// Takes steps that Newton's method solves: `implicit`, `bdf2`, `tr-bdf2` and `quasi-static`, with every force
// at the end of the step or stage; and `semi-implicit` with self-contact, whose bending lags.
#pragma once

#include <optional>
#include <vector>

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
  // A stretch of a step, which has been halved so many times to get there.
  struct Part {
    double start, h;  // [s]
    int halvings = 0;

    bool is_shortest() const { return halvings == kMaxHalvings; }
  };
  // A stage of a part found no equilibrium: this is left of the part.
  struct Failure {
    Part rest;
    NewtonOutcome outcome;
  };
  void take_lagged_step(double start, double whole);
  void take_adaptive_step(double start, double whole);
  void take_interval(double start, double h);
  void take_in_halves(const Failure& failure);
  void push_halves(const Failure& failure, std::vector<Part>& ahead);
  std::optional<Failure> take_part(const Part& part);
  std::optional<Failure> finish_part(const Part& part);
  NewtonOutcome attempt_first_stage(const Part& part);
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
