// One step of the chapter's scheme (Wong, Leach, Zambetta 2013, 4.3; Schroeder et al. 2011), hi = alpha he:
//
//   alpha times   v += he M^-1 (f_bend(x) + m g + f_air + F_n),  x += he v;  bending history committed at each x
//   then          M dv = hi (f_m + f_d + f_c - F_n),  v += dv,  x += hi dv,  F_{n+1} = F_n + M dv/hi
//
// with f_m membrane tension, f_d membrane damping, f_c contact and friction at the end of the step, linearised (one
// Newton step; with obstacles kNewtonWithObstacles of them) and the matrix kept positive definite.
//
// Decided here: F_n, the implicit force of the last step, is held through the substeps, and the implicit stage brings
// its change alone.  Without it (F_n = 0, the scheme in its plainest form) forces that balance act one after the other:
// bending accelerates the cloth through the substeps, tension throws it back, a resting cloth trembles by |a| hi^2, its
// friction is rubbed away and the splitting feeds in more energy than the cloth ever had.  For alpha = 1 both are the
// backward Euler step.  Bending viscosity (fabric.damping times b1) is explicit.
//
// Ledger.  Each velocity change dv under a force F over a displacement d = dt v_new gives exactly
//   change of kinetic energy = F.d - m |dv|^2/2,
// so the integrator's own loss is the sum of m |dv|^2/2 plus, for each energy, the gap between its change and the
// work -F.d of the force that stands for it: the convexity gap W_n - W_{n+1} + F.(x_{n+1} - x_n) and the splitting
// of the step, whose two stages move the cloth apart.
#include "sim/solve/stepper.h"

#include "sim/error.h"

namespace hysteron {

namespace {
constexpr int kNewtonWithObstacles = 2;
constexpr int kMostIterations = 2000;
}  // namespace

template <class Real, class Device>
void Stepper<Real, Device>::advance(int steps) {
  const Real h = static_cast<Real>(scene_.step), he = static_cast<Real>(limits_.substep);
  for (int s = 0; s < steps; ++s) {
    hold();
    if (contact_) {
      contact_->move(time(), time() + scene_.step);
      const Vec3<Real>* x = x_.data();
      Vec3<Real>* before = before_.data();
      for_each(*device_, "remember positions", vertices_, HYST_KERNEL(int i) { before[i] = x[i]; });
    }
    for (int k = 0; k < limits_.substeps; ++k)
      if (explicit_)
        explicit_substep(he);
      else
        substep(he);
    if (!explicit_) implicit_stage();
    if (contact_) {
      clock_.begin(Stage::contact);
      contact_->commit(x_.data(), before_.data());
      clock_.end(Stage::contact);
    }
    if (!explicit_) membrane_.add_viscous_loss(v_.data(), h);
    ++step_count_;
  }
}

// Held vertices move at the constant velocity that brings them to their place at the end of the step.
template <class Real, class Device>
void Stepper<Real, Device>::hold() {
  if (held_changes_) {
    std::vector<char> held(vertices_);
    for (int i = 0; i < vertices_; ++i) held[i] = pin_host_[i] >= 0 && time() < scene_.pin[pin_host_[i]].until;
    held_.upload(held);
    held_changes_ = false;
    for (const Pin& pin : scene_.pin) held_changes_ |= pin.until > time() && pin.until < scene_.seconds;
  }
  if (!moving_pins_) return;
  PinPlacements<Real> placements;
  for (std::size_t p = 0; p < scene_.pin.size(); ++p) {
    const Placement at = placement(scene_.pin[p].motion, time() + scene_.step);
    placements.rotation[p] = at.rotation.template cast<Real>();
    placements.translation[p] = at.translation.template cast<Real>();
  }
  const int* pin = pin_.data();
  const char* held = held_.data();
  const Vec3<Real>*start = start_.data(), *x = x_.data();
  Vec3<Real>* v = v_.data();
  const Real h = static_cast<Real>(scene_.step);
  for_each(*device_, "handles", vertices_, HYST_KERNEL(int i) {
    if (!held[i]) return;
    const int p = pin[i];
    v[i] = (placements.rotation[p] * start[i] + placements.translation[p] - x[i]) / h;
  });
}

template <class Real, class Device>
void Stepper<Real, Device>::substep(Real dt) {
  clock_.begin(Stage::bending);
  bending_.commit(x_.data(), v_.data(), dt);
  const BendingForceView<Real> bending = bending_.forces();
  const Vec3<Real> g = scene_.gravity.cast<Real>();
  const Real drag = static_cast<Real>(scene_.air_drag / scene_.fabric.density);
  const Real* mass = mass_.data();
  const char* held = held_.data();
  Vec3<Real>*x = x_.data(), *v = v_.data();
  const Vec3<Real>* carried = carried_.data();
  VertexLedger* ledger = ledger_.data();
  for_each(*device_, "substep", vertices_, HYST_KERNEL(int i) {
    const Vec3<Real> force = bending.at(i);
    const Real m = mass[i];
    const Vec3<Real> weight = m * g;
    VertexLedger& sum = ledger[i];
    if (held[i]) {
      const Vec3<Real> d = dt * v[i];
      sum.handle_work -= static_cast<double>((force + weight).dot(d));
      sum.bending_work += static_cast<double>(force.dot(d));
      sum.gravity_work += static_cast<double>(weight.dot(d));
      x[i] += d;
      return;
    }
    const Vec3<Real> air = -drag * m * v[i];
    const Vec3<Real> dv = dt / m * (force + weight + air + carried[i]);
    const Vec3<Real> moved = v[i] + dv, d = dt * moved;
    v[i] = moved;
    x[i] += d;
    sum.bending_work += static_cast<double>(force.dot(d));
    sum.gravity_work += static_cast<double>(weight.dot(d));
    sum.implicit_work += static_cast<double>(carried[i].dot(d));
    sum.air -= static_cast<double>(air.dot(d));
    sum.inertia += static_cast<double>(m / 2 * dv.squaredNorm());
  });
  clock_.end(Stage::bending);
}

template <class Real, class Device>
void Stepper<Real, Device>::explicit_substep(Real dt) {
  bending_.commit(x_.data(), v_.data(), dt);
  membrane_.update(x_.data(), v_.data());
  const BendingForceView<Real> bending = bending_.forces();
  const MembraneForceView<Real> membrane = membrane_.forces();
  Vec3<Real>* force = rhs_.data();
  for_each(*device_, "explicit forces", vertices_, HYST_KERNEL(int i) { force[i] = membrane.at(i); });
  if (contact_) contact_->add_forces(x_.data(), before_.data(), force);
  const Vec3<Real> g = scene_.gravity.cast<Real>();
  const Real drag = static_cast<Real>(scene_.air_drag / scene_.fabric.density);
  const Real* mass = mass_.data();
  const char* held = held_.data();
  Vec3<Real>*x = x_.data(), *v = v_.data();
  VertexLedger* ledger = ledger_.data();
  for_each(*device_, "explicit substep", vertices_, HYST_KERNEL(int i) {
    const Vec3<Real> bend = bending.at(i), rest = force[i], weight = mass[i] * g;
    VertexLedger& sum = ledger[i];
    const Vec3<Real> air = held[i] ? Vec3<Real>(Vec3<Real>::Zero()) : Vec3<Real>(-drag * mass[i] * v[i]);
    if (!held[i]) {
      const Vec3<Real> dv = dt / mass[i] * (bend + rest + weight + air);
      v[i] += dv;
      sum.inertia += static_cast<double>(mass[i] / 2 * dv.squaredNorm());
    }
    const Vec3<Real> d = dt * v[i];
    x[i] += d;
    sum.bending_work += static_cast<double>(bend.dot(d));
    sum.gravity_work += static_cast<double>(weight.dot(d));
    sum.implicit_work += static_cast<double>(rest.dot(d));
    sum.air -= static_cast<double>(air.dot(d));
    if (held[i]) sum.handle_work -= static_cast<double>((bend + rest + weight).dot(d));
  });
  membrane_.add_viscous_loss(v_.data(), dt);
}

// rhs = hi (f_m + f_d + f_c - F_n) - M (v - v*), matrix = M + hi^2 K + hi D at the present iterate.
template <class Real, class Device>
void Stepper<Real, Device>::linear_system(Real h, bool first) {
  clock_.begin(Stage::membrane);
  membrane_.update(x_.data(), v_.data());
  const BlockRowsView<Real> matrix = matrix_.view();
  membrane_.assemble(h, matrix);
  const MembraneForceView<Real> force = membrane_.forces();
  const Real* mass = mass_.data();
  const Vec3<Real>*total = change_.data(), *carried = carried_.data();
  Vec3<Real>* rhs = rhs_.data();
  for_each(*device_, "implicit forces", vertices_, HYST_KERNEL(int i) {
    rhs[i] = h * (force.at(i) - carried[i]);
    if (!first) rhs[i] -= mass[i] * total[i];
    for (int k = 0; k < 3; ++k) matrix.diagonal[i](k, k) += mass[i];
  });
  clock_.end(Stage::membrane);
  if (!contact_) return;
  clock_.begin(Stage::contact);
  contact_->add(x_.data(), before_.data(), h, rhs, matrix.diagonal);
  clock_.end(Stage::contact);
}

template <class Real, class Device>
void Stepper<Real, Device>::implicit_stage() {
  const Real h = static_cast<Real>(scene_.step);
  const int newton = contact_ ? kNewtonWithObstacles : 1;
  for (int iteration = 0; iteration < newton; ++iteration) {
    linear_system(h, iteration == 0);
    clock_.begin(Stage::solve);
    const PcgOutcome outcome = pcg_.solve(matrix_.view(), held_.data(), rhs_.data(), carried_.data(), h,
                                          correction_.data(), scene_.solver_tolerance, kMostIterations);
    solver_iterations_ += outcome.iterations;
    const Vec3<Real>* dv = correction_.data();
    Vec3<Real>*x = x_.data(), *v = v_.data(), *total = change_.data();
    const char* held = held_.data();
    const bool first = iteration == 0;
    for_each(*device_, "correct", vertices_, HYST_KERNEL(int i) {
      if (held[i]) return;
      total[i] = first ? dv[i] : Vec3<Real>(total[i] + dv[i]);
      v[i] += dv[i];
      x[i] += h * dv[i];
    });
    clock_.end(Stage::solve);
  }
  accept_implicit();
}

// The impulse that really acted is M dv, whatever the linearisation and the solver's tolerance made of it.  The force
// on a held vertex is that of the last linear system: rhs - (matrix dv) without the mass, which dv = 0 leaves out.
template <class Real, class Device>
void Stepper<Real, Device>::accept_implicit() {
  const Real* mass = mass_.data();
  const char* held = held_.data();
  const Vec3<Real>*v = v_.data(), *total = change_.data(), *rhs = rhs_.data();
  const Vec3<Real>* last = correction_.data();
  Vec3<Real>* carried = carried_.data();
  const Real h = static_cast<Real>(scene_.step);
  const BlockRowsView<Real> matrix = matrix_.view();
  const bool handles = moving_pins_;
  VertexLedger* ledger = ledger_.data();
  for_each(*device_, "implicit ledger", vertices_, HYST_KERNEL(int i) {
    VertexLedger& sum = ledger[i];
    if (!held[i]) {
      carried[i] += mass[i] / h * total[i];
      sum.inertia += static_cast<double>(mass[i] / 2 * total[i].squaredNorm());
      sum.implicit_work += static_cast<double>(mass[i] * total[i].dot(v[i]));
    } else if (handles) {
      const double work = static_cast<double>((rhs[i] - matrix.times(i, last)).dot(v[i]));
      sum.implicit_work += work;
      sum.handle_work -= work;
    }
  });
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
