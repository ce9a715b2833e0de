// Solves the linear systems of Newton's method to a relative tolerance.
#pragma once

#include "sim/linear/pcg.h"

namespace hysteron {

template <class Real, class Device>
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // Announces similar systems that hold the same rows until it is called again: those of a step, whatever its
  // stages.
  virtual void begin() {}
  // Solves system * x = rhs (n vertices each) for the rows that are not held (n flags); x is zero on held
  // rows.
  virtual PcgOutcome solve(const LinearSystem<Real, Device>& system, const char* held, const Vec3<Real>* rhs,
                           Vec3<Real>* x, double tolerance) = 0;
  virtual bool is_direct() const { return false; }  // a few iterations reach any tolerance
  virtual void serialise(Archive& archive) = 0;     // saves or loads the state that outlives a solve
  virtual std::size_t bytes() const = 0;
};

// Conjugate gradients with the inverted diagonal blocks.
template <class Real, class Device>
class BlockJacobiSolver : public LinearSolver<Real, Device> {
 public:
  BlockJacobiSolver(Device& device, int rows) : pcg_(device, rows) {}
  PcgOutcome solve(const LinearSystem<Real, Device>& system, const char* held, const Vec3<Real>* rhs,
                   Vec3<Real>* x, double tolerance) override {
    constexpr int kMaxIterations = 20000;
    return pcg_.solve(system, held, rhs, nullptr, nullptr, x, {tolerance, kMaxIterations});
  }
  void serialise(Archive& archive) override { pcg_.serialise(archive); }
  std::size_t bytes() const override { return pcg_.bytes(); }

 private:
  Pcg<Real, Device> pcg_;
};

}  // namespace hysteron
