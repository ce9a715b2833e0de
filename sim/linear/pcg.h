// Conjugate gradients for the implicit solve, preconditioned by the inverted diagonal blocks or by the
// caller's preconditioner.
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

// Returns how many decades the tolerance reduces the residual by.
inline double decades(double tolerance) {
  constexpr double kMin = 0.5;
  return std::max(-std::log10(tolerance), kMin);
}

// A stiffness that is applied element by element: it returns -K times a displacement (n vertices [m]).
template <class Real>
using StiffnessProduct = std::function<GatheredForces<Real>(const Vec3<Real>*)>;

// The system applies matrix * p, plus the stiffness of bending and of self-contact where they exist, plus the
// membrane's softening, which no preconditioner knows.
template <class Real, class Device>
struct LinearSystem {
  BlockRowsView<Real> matrix;
  StiffnessProduct<Real> bending = {};  // returns -K p; empty: none
  // Blocks of bending and self-contact (n), which are added to the matrix's before these are inverted.
  const Mat3<Real>* rest_diagonal = nullptr;
  Preconditioner<Real, Device>* preconditioner = nullptr;  // null: the inverted diagonal blocks
  ScalarRowsView<Real> softening = {};                     // null: none
  PairProduct<Real> pairs = {};                            // self-contact's; null: none
  // The least number of bytes that a product reads beside vectors; 0: not stated.
  std::size_t bytes = 0;
  // The matrix, softening and bending in one, which products then use; no rows: they are not assembled.
  BlockRowsView<Real> whole = {};
  std::size_t whole_blocks = 0;  // number of its off-diagonal blocks
  // The masses in the diagonal blocks (n), for a PcgEnd's rounding; may be null otherwise.
  const Real* mass = nullptr;
};

struct PcgEnd {
  double tolerance;  // relative
  int most_iterations;
  // The inherent uncertainty of x: the residual need not be less than the system's stiffness makes of it.  It
  // counts in systems with their mass and without the caller's preconditioner.
  double rounding = 0;
};

template <class Real, class Device>
class Pcg {
 public:
  // preconditioned: every system has its own preconditioner.
  Pcg(Device& device, int rows, bool preconditioned = false);

  using System = LinearSystem<Real, Device>;

  // Solves the system for the rows that are not held (held: n flags); x (n vertices) is zero on held rows,
  // where rhs (n vertices) is not read.  It starts from the multiple of `guess` (n vertices; may be x) that
  // is best in the matrix's norm, from x = 0 if guess is null, and ends when sqrt(r' P r) <= tolerance *
  // sqrt(s' P s), s = rhs - known, with P the preconditioner: where the known impulses (n vertices; may be
  // null) balance those of the implicit forces, these set the scale.  It also ends, unconverged, after a step
  // along a direction p with p' matrix p <= 0, which is taken downwards and as long as if that were its
  // magnitude.
  PcgOutcome solve(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
                   const Vec3<Real>* guess, Vec3<Real>* x, PcgEnd end);
  // Saves or loads how fast the last solve converged, which sets the size of a GPU's batches.
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
  // These are the loops of an iteration; iterations() orders those of bending's product.
  PcgIterations<Real> iterations(const System& system, const char* held, Vec3<Real>* x);
  bool iterate_on_device(const System& system, const char* held, Vec3<Real>* x);
  PcgScalars iterate_in_batches(const System& system, const char* held, Vec3<Real>* x, PcgEnd end);
  PcgScalars scalars() const;
  std::size_t vectors(int count) const { return count * r_.bytes(); }

  Device& device_;
  int rows_;
  double iterations_per_decade_ = 4;  // per decade of the tolerance
  Buffer<Mat3<Real>, Device> inverse_;
  Buffer<Vec3<Real>, Device> r_, z_, p_, q_;
  Buffer<Vec3<Real>, Device> other_p_;  // for iterations in one launch
  Buffer<PcgScalars, Device> scalars_;
  WhileLoop<Device> loop_;
};

}  // namespace hysteron
