// Poses an implicit step as a minimum problem (Martin et al. 2011 for elastic bodies; with hysteresis because
// moment is a function of curvature from the accepted history on):
//
//   Phi(x) = sum m/2 |x - y|^2/beta_dt^2 + drag m/2 |x - r|^2/beta_dt - m g.(x - x_n)
//            + membrane + bending law + viscosity + contact + friction + pins of limited strength [J]
//
// Bending that lags (in `semi-implicit`) has the force of the state accepted last: -f.(x - x_n) takes the
// place of its energy.
//
// The reference position r is the formula's, and y = r + beta_dt * (the same combination of velocities).
// Statics have beta_dt = infinity: no inertia, drag or viscosity.
#pragma once

#include <optional>
#include <string>

#include "sim/bending/assembled_stiffness.h"
#include "sim/contact/contact.h"
#include "sim/contact/self_contact.h"
#include "sim/device/host_result.h"
#include "sim/linear/pcg.h"
#include "sim/membrane/membrane.h"
#include "sim/scene/scene.h"
#include "sim/time/compliant_pins.h"

namespace hysteron {

// The data from which a step starts; pointers are to arrays of n vertices.
template <class Real>
struct StepStart {
  StepFormula formula, rates;              // for motion, and for the strain and angle rates of viscosity
  const Vec3<Real>*now, *before;           // x_n, x_{n-1} [m] (the latter unused without extrapolation)
  const Vec3<Real>*reference, *predicted;  // r, y [m]
  const char* held;                        // n flags
  Vec3<Real> gravity;                      // [m/s^2]
  Real drag;                               // air drag over mass [1/s]
  Real fraction;                           // acting share of the weight: statics let the load grow
  CompliantPins<Real> compliant_pins = {};
};

struct PotentialValue {
  double energy = 0;    // Phi [J]
  double size = 0;      // sum of the terms' magnitudes, which bounds rounding [J]
  double residual = 0;  // norm of the gradient over all free vertices [N]
  double reaction = 0;  // norm of the forces of rigid and compliant pins [N]
  double inertia = 0;   // norm of mass times acceleration over all free vertices [N]
  double internal = 0;  // norm of the membrane's and bending's forces over all vertices [N]
  double weight = 0;    // norm of the whole weight of all free vertices [N]
  double slope = 0;     // gradient . direction [J]
};

template <class Real, class Device>
class IncrementalPotential {
 public:
  IncrementalPotential(Device& device, BlockRows<Real, Device>& matrix, Membrane<Real, Device>& membrane,
                       Bending<Real, Device>& bending, Contact<Real, Device>* contact,
                       SelfContact<Real, Device>* self_contact, const Buffer<Real, Device>& mass,
                       bool bending_lags, const SolverTuning& tuning = {});

  void begin(const StepStart<Real>& start) {
    start_ = start;
    membrane_.begin_step(start.rates, start.now, start.before);
    if (!bending_lags_) bending_.begin_step(start.rates);
  }
  // Returns the largest step length along `direction` (n vertices [m]) from x, up to `max_step`, on which the
  // cloth does not pass through itself; feasible_step() also counts obstacles.  Points up to there may then
  // be evaluated; accept_iterate() states which of them was taken.  Bodies of triangles are at the start of
  // their way when a guess begins, and aim at a fraction of it; each trial step takes them along.  They have
  // to arrive before the potential is that of the stage's end.
  void begin_guess() {
    if (self_contact_) self_contact_->begin_guess();
  }
  void aim_bodies(double fraction) {
    if (self_contact_) self_contact_->aim_bodies(fraction);
  }
  void take_bodies(double step_length) {
    if (self_contact_) self_contact_->try_step(step_length);
  }
  bool bodies_have_arrived() const { return !self_contact_ || self_contact_->bodies_have_arrived(); }
  double collision_free_step(const Vec3<Real>* x, const Vec3<Real>* direction, double max_step,
                             double kept_share = 0) {
    return self_contact_ ? self_contact_->prepare(x, direction, start_.held, max_step, kept_share) : max_step;
  }
  double feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction, double max_step) {
    const double outside = contact_ ? contact_->feasible_step(x, direction, start_.held, max_step) : max_step;
    return collision_free_step(x, direction, outside);
  }
  void accept_iterate(const Vec3<Real>* x) {
    if (self_contact_) self_contact_->accept_iterate(x);
  }
  // Ends the paths of free vertices to `end` before obstacles that bar them; true if none does.
  void clip_to_obstacles(Vec3<Real>* end) {
    if (contact_) contact_->clip_to_obstacles(start_.now, end, start_.held);
  }
  bool path_is_clear(const Vec3<Real>* end) {
    return !contact_ || contact_->path_is_clear(start_.now, end, start_.held);
  }
  bool has_self_contact() const { return self_contact_ != nullptr; }
  // Updates the limits of friction from the contact at x, which changes Phi.
  void update_friction_limits(const Vec3<Real>* x) {
    if (contact_) contact_->update_lagged_friction(x);
    if (self_contact_) self_contact_->update_lagged_friction(x);
  }
  // Returns Phi with its gradient at x (n vertices [m]); the direction may be null.  The host waits for the
  // device.
  PotentialValue evaluate(const Vec3<Real>* x, const Vec3<Real>* direction) {
    membrane_.evaluate(x);
    if (!bending_lags_) bending_.evaluate(x);
    return balance(x, direction);
  }
  // Returns the same at x, where evaluate() was called last, with limits of friction from there.
  PotentialValue renew_friction(const Vec3<Real>* x) {
    // Membrane and bending need no new evaluation.
    update_friction_limits(x);
    return balance(x, nullptr);
  }
  // Returns the Hessian where evaluate() was called last, with `shift` times the masses added [1/s^2], and
  // fills descent().  It is positive semidefinite unless `full` (for use near the minimum): that includes the
  // softening under compression, and friction that slides more easily (sliding_stop.h).  Bending's part is
  // Gauss-Newton's, without the second derivatives of angles.
  LinearSystem<Real, Device> linearise(const Vec3<Real>* x, Real shift, bool full);
  // Makes linearise() assemble the whole Hessian but for self-contact; bending must not lag.
  void assemble() { whole_.emplace(device_, matrix_, bending_); }
  void serialise(Archive& archive) { hysteron::serialise(archive, device_, gradient_); }
  const Vec3<Real>* gradient() const { return gradient_.data(); }  // held vertices included [N]
  const Vec3<Real>* descent() const { return descent_.data(); }    // -gradient at the last linearise() [N]
  // Returns which part is not finite at x, in a user's words; "" if none.
  std::string not_finite(const Vec3<Real>* x);
  bool has_friction() const { return contact_ || self_contact_; }
  std::size_t bytes() const {
    return total_bytes(gradient_, descent_, rest_diagonal_, softening_off_diagonal_, softening_diagonal_,
                       vertex_totals_) +
           (whole_ ? whole_->bytes() : 0);
  }

  struct Totals {
    double energy, size, internal2, inertia2, weight2, residual2, reaction2, slope;
  };
  // The energies of contact, self-contact, membrane and bending, in the order in which they are added.
  struct Energies {
    const double* list[4] = {};  // [J]
    int count[4] = {};
  };

  // The parts of evaluate(); public because nvcc allows no device lambda in a private member function.
  void compute_gradient(const Vec3<Real>* x);
  void add_up(const Energies& energies, const Vec3<Real>* x, const Vec3<Real>* direction);

 private:
  PotentialValue balance(const Vec3<Real>* x, const Vec3<Real>* direction);
  Energies energies();
  std::size_t vertex_bytes(int vectors) const { return vectors * gradient_.bytes(); }
  Device& device_;
  BlockRows<Real, Device>& matrix_;
  Membrane<Real, Device>& membrane_;
  Bending<Real, Device>& bending_;
  Contact<Real, Device>* contact_;
  SelfContact<Real, Device>* self_contact_;
  const Buffer<Real, Device>& mass_;
  bool bending_lags_;
  SolverTuning tuning_;
  int vertices_;
  StepStart<Real> start_{};
  Buffer<Vec3<Real>, Device> gradient_, descent_;
  Buffer<Mat3<Real>, Device> rest_diagonal_;
  Buffer<Real, Device> softening_off_diagonal_, softening_diagonal_;
  std::optional<AssembledStiffness<Real, Device>> whole_;
  Buffer<Totals, Device> vertex_totals_;  // partial sums of compute_gradient()
  HostResult<Totals, Device> totals_;
};

}  // namespace hysteron
