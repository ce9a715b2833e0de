// Linear systems of double precision solved in single precision.
//
// Newton's method asks for a direction that is right to its forcing term, which is never below 1e-5: single
// precision has that, and its iterations move half the bytes.  What the direction is judged by, forces and
// energies, stays in double, so that the steps end where they would.  Each system is rounded once, number by
// number, where it was linearised; its right-hand side is divided by its norm first, so that nothing depends
// on how small the forces have become.
#pragma once

#include <memory>

#include "sim/device/algorithms.h"
#include "sim/linear/gathered_forces.h"
#include "sim/linear/linear_solver.h"

namespace hysteron {

template <class Device>
class FloatSolver : public LinearSolver<double, Device> {
 public:
  // A tighter tolerance is taken as this one: rounding of the systems leaves no more.
  static constexpr double kTightest = 1e-5;

  // For matrices of this pattern; bending of the systems, null where they have none.
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
  Buffer<Mat3<float>, Device> whole_off_diagonal_, whole_diagonal_;  // empty before the first whole system
  Buffer<float, Device> softening_off_diagonal_, softening_diagonal_;
  Buffer<Vec3<float>, Device> rhs_, x_;
  Buffer<double, Device> norm_;  // of the right-hand side [N]; 1 if that is zero
};

}  // namespace hysteron
