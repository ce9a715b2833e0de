// Conjugate gradients for the implicit solve, preconditioned by the inverted diagonal blocks or by what the
// caller brings.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/base/archive.h"
#include "sim/device/while_loop.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/gathered_forces.h"
#include "sim/linear/pair_product.h"
#include "sim/linear/pcg_in_one_launch.h"
#include "sim/linear/preconditioner.h"

namespace hysteron {

struct PcgOutcome {
  int iterations = 0;
  bool converged = false;
};

// How many times the tolerance makes a tenth of the residual.
inline double decades(double tolerance) {
  constexpr double kMin = 0.5;
  return std::max(-std::log10(tolerance), kMin);
}

// A stiffness that is applied element by element: what it makes of a displacement [m].
template <class Real>
using StiffnessProduct = std::function<GatheredForces<Real>(const Vec3<Real>*)>;

// matrix * p, plus the stiffness of bending and of self-contact where they are, plus the membrane's
// softening, which no preconditioner knows.
template <class Real, class Device>
struct LinearSystem {
  BlockRowsView<Real> matrix;
  StiffnessProduct<Real> bending = {};  // -K p; empty: none
  // Of bending and self-contact: added to the matrix's blocks before they are inverted.
  const Mat3<Real>* rest_diagonal = nullptr;
  Preconditioner<Real, Device>* preconditioner = nullptr;  // null: the inverted diagonal blocks
  ScalarRowsView<Real> softening = {};                     // null: none
  PairProduct<Real> pairs = {};                            // of self-contact; null: none
  std::size_t bytes = 0;  // that a product reads at least beside vectors, where that is stated
  // The matrix, softening and bending in one, which products then take; no rows: they are not assembled.
  BlockRowsView<Real> whole = {};
  std::size_t whole_blocks = 0;  // its off-diagonal ones
  const Real* mass = nullptr;    // in the diagonal blocks, where a PcgEnd's rounding counts
};

struct PcgEnd {
  double tolerance;
  int most_iterations;
  // What x is uncertain by anyway: the residual need not be less than what the system's stiffness makes of
  // it.  Counts in systems with their mass and without the caller's preconditioner.
  double rounding = 0;
};

template <class Real, class Device>
class Pcg {
 public:
  // preconditioned: every system brings its preconditioner.
  Pcg(Device& device, int rows, bool preconditioned = false);

  using System = LinearSystem<Real, Device>;

  // Solves the system for the rows that are not held; held rows of x are zero, and rhs is not read there.
  // Starts from the multiple of `guess` that is best in the matrix's norm, from x = 0 if guess is null;
  // `guess` may be x itself. Ends when sqrt(r' P r) <= tolerance * sqrt(s' P s), s = rhs - known, P the
  // preconditioner: where known impulses balance those of the implicit forces, these set the scale.
  // known may be null.  Ends, too, after a step along a direction p with p' matrix p <= 0, taken
  // downwards and as long as if that were its magnitude; then it has not converged.
  PcgOutcome solve(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
                   const Vec3<Real>* guess, Vec3<Real>* x, PcgEnd end);
  // How fast the last solve converged, on which the batches depend that a GPU is sent.
  void serialise(Archive& archive) { archive(iterations_per_decade_); }
  std::size_t bytes() const;

  // The parts of solve(); public because nvcc allows no device lambda in a private member function.
  void project(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* guess);
  void start(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
             const Vec3<Real>* guess, Vec3<Real>* x, PcgEnd end);
  void start_preconditioned(const System& system, const char* held, const Vec3<Real>* rhs,
                            const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x, PcgEnd end);
  void find_target(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
                   PcgEnd end);
  void iterate(const System& system, const char* held, Vec3<Real>* x);
  template <bool kHasPairs>
  void multiply(const ProductTerms<Real, kHasPairs>& product, std::size_t bytes);

 private:
  // Its loops; orders those of bending's product.
  PcgIterations<Real> iterations(const System& system, const char* held, Vec3<Real>* x);
  bool iterate_on_device(const System& system, const char* held, Vec3<Real>* x);
  PcgScalars iterate_in_batches(const System& system, const char* held, Vec3<Real>* x, PcgEnd end);
  PcgScalars scalars() const;
  std::size_t vectors(int count) const { return count * r_.bytes(); }

  Device& device_;
  int rows_;
  double iterations_per_decade_ = 4;  // of the tolerance
  Buffer<Mat3<Real>, Device> inverse_;
  Buffer<Vec3<Real>, Device> r_, z_, p_, q_;
  Buffer<Vec3<Real>, Device> other_p_;  // for iterations in one launch
  Buffer<PcgScalars, Device> scalars_;
  WhileLoop<Device> loop_;
};

}  // namespace hysteron
