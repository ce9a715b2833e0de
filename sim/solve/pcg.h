// Conjugate gradients for the implicit solve, preconditioned by the inverted diagonal blocks.
#pragma once

#include "sim/solve/block_rows.h"

namespace hysteron {

struct PcgOutcome {
  int iterations = 0;
  bool converged = false;
};

template <class Real, class Device>
class Pcg {
 public:
  Pcg(Device& device, int rows);

  // Solves matrix * x = rhs for the rows that are not held; held rows of x are zero.
  // Starts from the multiple of `guess` that is best in the matrix's norm, from x = 0 if guess is null;
  // `guess` may be x itself. Ends when sqrt(r' P r) <= tolerance * sqrt(s' P s), s = rhs - known, P the
  // inverted diagonal blocks: where known impulses balance those of the implicit forces, these set the scale.
  // known may be null.
  PcgOutcome solve(BlockRowsView<Real> matrix, const char* held, const Vec3<Real>* rhs,
                   const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x, double tolerance,
                   int most_iterations);
  std::size_t bytes() const;

  struct Scalars {  // on the device, so that iterations need no word from the host
    double residual, target, alpha, beta;
    int iterations, done;
  };
  // The parts of solve(); public because nvcc allows no device lambda in a private member function.
  void project(BlockRowsView<Real> matrix, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* guess);
  void start(BlockRowsView<Real> matrix, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
             const Vec3<Real>* guess, Vec3<Real>* x, double tolerance);
  void iterate(BlockRowsView<Real> matrix, const char* held, Vec3<Real>* x);

 private:
  Device& device_;
  int rows_;
  int last_iterations_ = 8;
  Buffer<Mat3<Real>, Device> inverse_;
  Buffer<Vec3<Real>, Device> r_, z_, p_, q_;
  Buffer<Scalars, Device> scalars_;
};

}  // namespace hysteron
