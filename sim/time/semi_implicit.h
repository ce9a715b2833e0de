// Takes bending explicitly, and tension, damping and contact implicitly, linearised.
#pragma once

#include "sim/linear/pcg.h"
#include "sim/time/time_integrator.h"

namespace hysteron {

// Follows the scene's implicit-every: `substep` has all forces act together in every substep; `step`, as the
// chapter writes it, takes explicit substeps, then one solve.
template <class Real, class Device>
class SemiImplicit : public TimeIntegrator<Real, Device> {
 public:
  SemiImplicit(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start, double h) override;
  void serialise(Archive& archive) override {
    archive(part_);
    pcg_.serialise(archive);
    hysteron::serialise(archive, *body_.device, change_);  // the next solve starts from it
  }
  std::size_t bytes() const override {
    return pcg_.bytes() + total_bytes(change_, correction_, rhs_, impulse_);
  }

  // These are parts of step(); public because nvcc allows no device lambda in a private member function.
  // gather_impulses() adds bending and external forces over h [s], and moves the cloth on by its velocity,
  // where the solve linearises.
  void gather_impulses(Real h);
  void substep(Real dt);  // takes an explicit substep
  void assemble(Real h, const Vec3<Real>* impulse, bool first);
  void correct(Real h, bool first);
  void update_ledger(Real h, const Vec3<Real>* impulse);
  double change_size();  // returns the last stage's velocity change, root mean square by mass [m/s]

 private:
  using TimeIntegrator<Real, Device>::body_;
  void stage(double start, Real h);
  void take_adaptive_step(double start, double whole);
  void take_chapter_step(double start, double whole);
  // Solves the implicit stage of both kinds over h [s], M dv = impulse + h (f_m + f_d + f_c)(x + h dv, v +
  // dv), by one Newton step, with obstacles a few, from where the explicit forces left the cloth.  `impulse`
  // (n vertices [N s]) is that of explicit forces which act in this stage too; null where they have acted
  // before.
  void solve(Real h, const Vec3<Real>* impulse);

  StepLimits limits_;
  double part_ = 0;  // the next part of an adaptive step [s]
  double blur_;      // accuracy beyond which positions need not be solved for [m]
  Pcg<Real, Device> pcg_;
  Buffer<Vec3<Real>, Device> change_, correction_;  // dv of the stage, and of its last Newton step [m/s]
  Buffer<Vec3<Real>, Device> rhs_;                  // [N s]
  Buffer<Vec3<Real>, Device> impulse_;              // [N s], for implicit-every = substep
  Buffer<double, Device> size_;
};

// Takes `explicit` steps: symplectic Euler with every force explicit.
template <class Real, class Device>
class ExplicitEuler : public TimeIntegrator<Real, Device> {
 public:
  ExplicitEuler(Body<Real, Device>& body, const StepLimits& limits);
  void step(double start, double h) override;
  void serialise(Archive&) override {}  // forces are made anew in each substep
  std::size_t bytes() const override { return force_.bytes(); }

  void substep(Real dt);  // public because nvcc allows no device lambda in a private member function

 private:
  using TimeIntegrator<Real, Device>::body_;
  int substeps_;
  Buffer<Vec3<Real>, Device> force_;  // force of membrane and contact [N]
};

}  // namespace hysteron
