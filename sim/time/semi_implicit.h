// Bending explicit; tension, damping and contact implicit, linearised.
#pragma once

#include "sim/linear/pcg.h"
#include "sim/time/time_integrator.h"

namespace hysteron {

// The implicit stage of both: M dv = impulse + h (f_m + f_d + f_c)(x + h dv, v + dv), one Newton step of it,
// with obstacles a few.
template <class Real, class Device>
class LinearisedSolve {
 public:
  explicit LinearisedSolve(Body<Real, Device>& body);
  // From where the explicit forces left the cloth, over h.  `impulse`: of explicit forces that act in this
  // stage too [N s]; null where they have acted before.
  void solve(Real h, const Vec3<Real>* impulse);
  // The last stage's velocity change, from which the next solve starts.
  void serialise(Archive& archive);
  double change_size();  // root mean square of the last stage's velocity change, by mass [m/s]
  std::size_t bytes() const { return pcg_.bytes() + change_.bytes() + correction_.bytes() + rhs_.bytes(); }

  // The parts; public because nvcc allows no device lambda in a private member function.
  void assemble(Real h, const Vec3<Real>* impulse, bool first);
  void correct(Real h, bool first);
  void book(Real h, const Vec3<Real>* impulse);

 private:
  Body<Real, Device>& body_;
  double blur_;  // of positions: what need not be solved for [m]
  Pcg<Real, Device> pcg_;
  Buffer<Vec3<Real>, Device> change_, correction_;  // dv of the stage, and of its last Newton step [m/s]
  Buffer<Vec3<Real>, Device> rhs_;                  // [N s]
  Buffer<double, Device> size_;
};

// implicit-every = substep: all forces act together in every substep.
template <class Real, class Device>
class SemiImplicit : public TimeIntegrator<Real, Device> {
 public:
  SemiImplicit(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start) override;
  void serialise(Archive& archive) override {
    archive(part_);
    solve_.serialise(archive);
  }
  std::size_t bytes() const override { return solve_.bytes() + impulse_.bytes(); }

  // Bending and external forces over h, and the cloth moved on by its velocity: where the solve linearises.
  void gather_impulses(Real h);  // public because nvcc allows no device lambda in a private member function

 private:
  using TimeIntegrator<Real, Device>::body_;
  void stage(double start, Real h);
  void take_adaptive_step(double start);

  StepLimits limits_;
  double part_ = 0;  // of adaptive steps: the coming one [s]
  LinearisedSolve<Real, Device> solve_;
  Buffer<Vec3<Real>, Device> impulse_;  // [N s]
};

// implicit-every = step, as the chapter writes it: explicit substeps, then one solve.
template <class Real, class Device>
class ChapterSteps : public TimeIntegrator<Real, Device> {
 public:
  ChapterSteps(Body<Real, Device>& body, const StepLimits& limits)
      : TimeIntegrator<Real, Device>(body), substeps_(limits.substeps), solve_(body) {}
  void step(double start) override;
  void serialise(Archive& archive) override { solve_.serialise(archive); }
  std::size_t bytes() const override { return solve_.bytes(); }

  void substep(Real dt);  // public because nvcc allows no device lambda in a private member function

 private:
  using TimeIntegrator<Real, Device>::body_;
  int substeps_;
  LinearisedSolve<Real, Device> solve_;
};

// `explicit`: symplectic Euler, every force explicit.
template <class Real, class Device>
class ExplicitEuler : public TimeIntegrator<Real, Device> {
 public:
  ExplicitEuler(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start) override;
  void serialise(Archive&) override {}  // forces are those of each substep's start
  std::size_t bytes() const override { return force_.bytes(); }

  void substep(Real dt);  // public because nvcc allows no device lambda in a private member function

 private:
  using TimeIntegrator<Real, Device>::body_;
  int substeps_;
  Buffer<Vec3<Real>, Device> force_;  // of membrane and contact [N]
};

}  // namespace hysteron
