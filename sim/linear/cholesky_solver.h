// Conjugate gradients are preconditioned by a Cholesky factorisation of the whole matrix: mass, membrane and
// contact, and bending and self-contact, which products may apply element by element.
//
// A new factorisation solves a system in an iteration or two.  It is kept while it is worth it: the next
// systems of Newton's method differ little, and where more iterations have been taken with it than a new one
// would cost, or a system has not been solved after as many, the next system gets a new one.  The membrane's
// softening is left out, so that the factorisation is that of a positive definite matrix, and conjugate
// gradients find directions of negative curvature as with any other preconditioner.
#pragma once

#include <memory>

#include "sim/linear/linear_solver.h"

namespace hysteron {

// A factorisation of a system's matrix that preconditions similar systems.
template <class Real, class Device>
class Factorisation : public Preconditioner<Real, Device> {
 public:
  // Factorises anew; rows and columns of held vertices (n flags) become those of the identity.
  virtual void renew(const LinearSystem<Real, Device>& system, const char* held) = 0;
  virtual int refactor_threshold() const = 0;  // number of iterations that cost as much as renew()
  // Saves the matrix, which is factorised again on loading; `held` is as when the factorisation was made.
  virtual void serialise(Archive& archive, const std::vector<char>& held) = 0;
};

template <class Real, class Device>
class CholeskySolver : public LinearSolver<Real, Device> {
 public:
  using System = LinearSystem<Real, Device>;

  CholeskySolver(Device& device, int rows, std::unique_ptr<Factorisation<Real, Device>> factor)
      : device_(device), rows_(rows), pcg_(device, rows, true), factor_(std::move(factor)) {}

  void begin() override { may_hold_others_ = true; }
  PcgOutcome solve(const System& system, const char* held, const Vec3<Real>* rhs, Vec3<Real>* x,
                   double tolerance) override {
    System preconditioned = system;
    preconditioned.preconditioner = factor_.get();
    const auto attempt = [&](int most) {
      return pcg_.solve(preconditioned, held, rhs, nullptr, nullptr, x, {tolerance, most});
    };
    int before = 0;
    if (holds_the_same(held) && spent_ < factor_->refactor_threshold()) {
      const int most = factor_->refactor_threshold();
      const PcgOutcome outcome = attempt(most);
      spent_ += std::max(0, outcome.iterations - kWithNew);
      if (outcome.converged || outcome.iterations < most) return outcome;
      before = outcome.iterations;
    }
    renew(system, held);
    const PcgOutcome outcome = attempt(kMaxIterations);
    return {before + outcome.iterations, outcome.converged};
  }
  bool is_direct() const override { return true; }
  // Saves or loads the factorisation as its matrix, with which later solves go on.
  void serialise(Archive& archive) override {
    pcg_.serialise(archive);
    archive(spent_);
    archive(held_);
    if (!held_.empty()) factor_->serialise(archive, held_);
  }
  std::size_t bytes() const override { return pcg_.bytes() + factor_->bytes(); }

  long factorisations() const { return factorisations_; }  // since the start

 private:
  static constexpr int kMaxIterations = 20000;
  static constexpr int kWithNew = 2;  // iterations that even a new factorisation takes

  // Are the same vertices held as when the factorisation was made? A GPU's host checks only after begin().
  bool holds_the_same(const char* held) {
    if (held_.empty()) return false;
    if (Device::kGpu && !may_hold_others_) return true;
    may_hold_others_ = false;
    return downloaded(device_, held, rows_) == held_;
  }
  void renew(const System& system, const char* held) {
    factor_->renew(system, held);
    held_ = downloaded(device_, held, rows_);
    may_hold_others_ = false;
    spent_ = 0;
    ++factorisations_;
  }

  Device& device_;
  int rows_;
  Pcg<Real, Device> pcg_;
  std::unique_ptr<Factorisation<Real, Device>> factor_;
  std::vector<char> held_;  // flags when it was made; empty: there is none
  bool may_hold_others_ = true;
  int spent_ = 0;  // iterations with it that a new one would have saved
  long factorisations_ = 0;
};

}  // namespace hysteron
