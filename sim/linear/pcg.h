// Conjugate gradients for the implicit solve, preconditioned by the inverted diagonal blocks or by what the
// caller brings.
#pragma once

#include <functional>

#include "sim/base/archive.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/gathered_forces.h"
#include "sim/linear/preconditioner.h"

namespace hysteron {

struct PcgOutcome {
  int iterations = 0;
  bool converged = false;
};

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
  StiffnessProduct<Real> self_contact = {};                // K p; empty: none
};

template <class Real, class Device>
class Pcg {
 public:
  Pcg(Device& device, int rows);

  using System = LinearSystem<Real, Device>;

  // Solves the system for the rows that are not held; held rows of x are zero, and rhs is not read there.
  // Starts from the multiple of `guess` that is best in the matrix's norm, from x = 0 if guess is null;
  // `guess` may be x itself. Ends when sqrt(r' P r) <= tolerance * sqrt(s' P s), s = rhs - known, P the
  // preconditioner: where known impulses balance those of the implicit forces, these set the scale.
  // known may be null.  Ends, too, after a step along a direction p with p' matrix p <= 0, taken
  // downwards and as long as if that were its magnitude; then it has not converged.
  PcgOutcome solve(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
                   const Vec3<Real>* guess, Vec3<Real>* x, double tolerance, int most_iterations);
  // How many iterations the last solve took, on which a GPU's next batches depend.
  void visit(Archive& archive) { archive(last_iterations_); }
  std::size_t bytes() const;

  enum Done { kNotYet, kConverged, kIndefinite };
  struct Scalars {  // on the device, so that iterations need no word from the host
    double residual, target, alpha, beta;
    int iterations, done, indefinite;

    HYST_HD void advance(double new_residual) {  // after a step that was not yet the last
      if (done) return;
      beta = new_residual / residual;
      residual = new_residual;
      iterations += 1;
      done = indefinite ? int(kIndefinite) : !(residual > target);
    }
  };
  // The parts of solve(); public because nvcc allows no device lambda in a private member function.
  void project(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* guess);
  void start(const System& system, const char* held, const Vec3<Real>* rhs, const Vec3<Real>* known,
             const Vec3<Real>* guess, Vec3<Real>* x, double tolerance);
  void start_preconditioned(const System& system, const char* held, const Vec3<Real>* rhs,
                            const Vec3<Real>* known, double tolerance);
  void iterate(const System& system, const char* held, Vec3<Real>* x);
  void advance(const char* held, Vec3<Real>* x);
  void advance_preconditioned(const System& system, const char* held, Vec3<Real>* x);

 private:
  Device& device_;
  int rows_;
  int last_iterations_ = 8;
  Buffer<Mat3<Real>, Device> inverse_;
  Buffer<Vec3<Real>, Device> r_, z_, p_, q_;
  Buffer<Scalars, Device> scalars_;
};

}  // namespace hysteron
