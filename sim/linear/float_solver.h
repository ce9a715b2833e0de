// Solves linear systems of double precision in single precision.
//
// Newton's method asks for a direction that is accurate to its forcing term, which is never below 1e-5:
// single precision achieves that, and its iterations move half the bytes.  Forces and energies, by which the
// direction is judged, stay in double, so that the steps end where they would.  Each system is rounded once,
// number by number, where it was linearised; its right-hand side is divided by its norm first, so that
// nothing depends on how small the forces have become.
#pragma once

#include <memory>

#include "sim/device/algorithms.h"
#include "sim/linear/gathered_forces.h"
#include "sim/linear/linear_solver.h"

namespace hysteron {

template <class Device>
class FloatSolver : public LinearSolver<double, Device> {
 public:
  // A tighter tolerance is replaced by this one: the rounding of the systems allows no less.
  static constexpr double kTightest = 1e-5;

  // Takes the pattern of the matrices, and bending's stiffness, null where systems have none.
  FloatSolver(Device& device, const BlockRows<double, Device>& pattern,
              std::unique_ptr<LinearSolver<float, Device>> solver,
              std::unique_ptr<FloatStiffness<Device>> bending);

  void begin() override { solver_->begin(); }
  PcgOutcome solve(const LinearSystem<double, Device>& system, const char* held, const Vec3<double>* rhs,
                   Vec3<double>* x, double tolerance) override;
  void serialise(Archive& archive) override { solver_->serialise(archive); }
  std::size_t bytes() const override;

  // The parts of solve(); public because nvcc allows no device lambda in a private member function.
  LinearSystem<float, Device> rounded(const LinearSystem<double, Device>& system);
  PairProduct<float> rounded(const PairProduct<double>& pairs);
  void scale_down(const char* held, const Vec3<double>* rhs);
  void scale_up(Vec3<double>* x);

 private:
  void take_whole(const LinearSystem<double, Device>& system, LinearSystem<float, Device>& result);

  Device& device_;
  std::unique_ptr<LinearSolver<float, Device>> solver_;
  std::unique_ptr<FloatStiffness<Device>> bending_;
  GrowingBuffer<PairStiffness<float>, Device> pair_;
  Buffer<Mat3<float>, Device> off_diagonal_, diagonal_, rest_diagonal_;
  Buffer<Mat3<float>, Device> whole_off_diagonal_, whole_diagonal_;  // empty until a system is assembled
  Buffer<float, Device> softening_off_diagonal_, softening_diagonal_;
  Buffer<Vec3<float>, Device> rhs_, x_;
  Buffer<double, Device> norm_;  // norm of the right-hand side [N]; 1 if that is zero
};

}  // namespace hysteron
