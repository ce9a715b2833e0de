// Bending explicit; tension, damping and contact implicit, linearised.
#pragma once

#include "sim/linear/pcg.h"
#include "sim/time/time_integrator.h"

namespace hysteron {

// Of the scene's implicit-every: `substep` has all forces act together in every substep; `step`, as the
// chapter writes it, takes explicit substeps, then one solve.
template <class Real, class Device>
class SemiImplicit : public TimeIntegrator<Real, Device> {
 public:
  SemiImplicit(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start, double h) override;
  void serialise(Archive& archive) override {
    archive(part_);
    pcg_.serialise(archive);
    hysteron::serialise(archive, *body_.device, change_);  // from which the next solve starts
  }
  std::size_t bytes() const override {
    return pcg_.bytes() + total_bytes(change_, correction_, rhs_, impulse_);
  }

  // The parts; public because nvcc allows no device lambda in a private member function.
  // Bending and external forces over h, and the cloth moved on by its velocity: where the solve linearises.
  void gather_impulses(Real h);
  void substep(Real dt);  // an explicit one
  void assemble(Real h, const Vec3<Real>* impulse, bool first);
  void correct(Real h, bool first);
  void book(Real h, const Vec3<Real>* impulse);
  double change_size();  // root mean square of the last stage's velocity change, by mass [m/s]

 private:
  using TimeIntegrator<Real, Device>::body_;
  void stage(double start, Real h);
  void take_adaptive_step(double start, double whole);
  void take_chapter_step(double start, double whole);
  // The implicit stage of both: M dv = impulse + h (f_m + f_d + f_c)(x + h dv, v + dv), one Newton step of
  // it, with obstacles a few.  From where the explicit forces left the cloth, over h.  `impulse`: of explicit
  // forces that act in this stage too [N s]; null where they have acted before.
  void solve(Real h, const Vec3<Real>* impulse);

  StepLimits limits_;
  double part_ = 0;  // of adaptive steps: the coming one [s]
  double blur_;      // of positions: what need not be solved for [m]
  Pcg<Real, Device> pcg_;
  Buffer<Vec3<Real>, Device> change_, correction_;  // dv of the stage, and of its last Newton step [m/s]
  Buffer<Vec3<Real>, Device> rhs_;                  // [N s]
  Buffer<Vec3<Real>, Device> impulse_;              // [N s]; of implicit-every = substep
  Buffer<double, Device> size_;
};

// `explicit`: symplectic Euler, every force explicit.
template <class Real, class Device>
class ExplicitEuler : public TimeIntegrator<Real, Device> {
 public:
  ExplicitEuler(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start, double h) override;
  void serialise(Archive&) override {}  // forces are those of each substep's start
  std::size_t bytes() const override { return force_.bytes(); }

  void substep(Real dt);  // public because nvcc allows no device lambda in a private member function

 private:
  using TimeIntegrator<Real, Device>::body_;
  int substeps_;
  Buffer<Vec3<Real>, Device> force_;  // of membrane and contact [N]
};

}  // namespace hysteron
