// Declares the preconditioner of conjugate gradients.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

// The scalars of conjugate gradients live on the device, so that iterations do not wait for the host.
struct PcgScalars {
  enum Done { kNotYet, kConverged, kIndefinite, kExhausted };
  double residual, target, alpha, beta;
  int iterations, most_iterations, done, indefinite;

  HYST_HD void begin(double first_residual, int most) {  // the target is set already
    residual = first_residual;
    iterations = 0;
    most_iterations = most;
    done = !(residual > target);
  }
  HYST_HD void find_length(double curvature) {  // sets the step length along p, from p' A p
    if (done) return;
    indefinite = !(curvature > 0);
    alpha = residual / (indefinite ? -curvature : curvature);
  }
  HYST_HD void advance(double new_residual) {  // ends a step that was not the last
    if (done) return;
    beta = new_residual / residual;
    residual = new_residual;
    iterations += 1;
    if (indefinite)
      done = kIndefinite;
    else if (!(residual > target))
      done = kConverged;
    else if (iterations >= most_iterations)
      done = kExhausted;
  }
};

// Takes a step along p: updates x, and the residual r.
template <class Real>
struct Advance {
  const char* held = nullptr;
  const Vec3<Real>*p = nullptr, *q = nullptr;  // n vertices each; q = A p, zero on held rows
  Vec3<Real>*x = nullptr, *r = nullptr;
  const PcgScalars* scalars = nullptr;

  HYST_HD void operator()(int i) const {
    if (!scalars->done && !held[i]) move(i);
  }
  HYST_HD void move(int i) const {
    const Real alpha = static_cast<Real>(scalars->alpha);
    x[i] += alpha * p[i];
    r[i] -= alpha * q[i];
  }
};

template <class Real>
struct OneLaunchView;

template <class Real, class Device>
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  // Sets z = P r for the rows that are not held, z = 0 for those that are (n vertices each); P is symmetric
  // and positive definite, and the same for all calls within a solve. r is zero on held rows.  With scalars
  // it advances them by r' P r, and does nothing once they are done.
  virtual void apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) = 0;
  // Takes the step and applies P to the residual that it leaves, or returns false and does neither.  The
  // scalars are on the device.
  virtual bool step_and_apply(const Advance<Real>& /*step*/, Vec3<Real>* /*z*/, PcgScalars* /*scalars*/) {
    return false;
  }
  // Describes P in the view as loops that a GPU runs in one launch (levels_in_one_launch.h); false: it has
  // none.
  virtual bool in_one_launch(OneLaunchView<Real>&) { return false; }
  virtual std::size_t bytes() const = 0;
};

}  // namespace hysteron
