// The linear systems of Newton's method, solved to a relative tolerance.
#pragma once

#include "sim/linear/pcg.h"

namespace hysteron {

template <class Real, class Device>
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // The systems that follow resemble one another until it is called again, and hold the same rows: those of a
  // step, whatever its stages.
  virtual void begin() {}
  // system * x = rhs for the rows that are not held, zero for those that are.
  virtual PcgOutcome solve(const LinearSystem<Real, Device>& system, const char* held, const Vec3<Real>* rhs,
                           Vec3<Real>* x, double tolerance) = 0;
  virtual bool is_direct() const { return false; }  // a few iterations reach any tolerance
  virtual void serialise(Archive& archive) = 0;     // what outlives a solve
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
