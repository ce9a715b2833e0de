// The step of hi = alpha he (Wong, Leach, Zambetta 2013, 4.3; Schroeder et al. 2011): bending explicit,
// tension, damping and contact implicit, alpha the least number of substeps for which explicit bending is
// stable.
//
// implicit-every = step, as the chapter writes it:
//   alpha times   v += he M^-1 (f_bend(x) + m g + f_air),  x += he v;  bending history committed at each x
//   then          M dv = hi (f_m + f_d + f_c)(x + hi dv, v + dv),  v += dv,  x += hi dv
//
// implicit-every = substep, the default (decided here): alpha times, with h = he,
//   M dv = h (f_bend(x) + m g + f_air + (f_m + f_d + f_c)(x + h v + h dv, v + dv)),  v += dv,  x += h v
//
// f_m is membrane tension, f_d membrane damping, f_c contact and friction, linearised (one Newton step; with
// obstacles kNewtonWithObstacles of them) and the matrix kept positive definite.  Both solve as many
// unknowns; the shorter implicit steps take fewer iterations each.  As the chapter writes it, forces that
// balance act one after the other: bending accelerates the cloth through the substeps and tension throws it
// back, so that a resting cloth trembles by about |a| hi^2, which rubs its bending friction away and feeds
// energy in; and bending waves whose period resonates with hi grow unless viscosity damps them.  Acting
// together they rest exactly.
//
// With self-contact the implicit part is solved to the end, as a minimum problem whose line search and
// collision detection keep layers apart (implicit_step.h); bending stays explicit.
//
// Ledger.  Each velocity change dv under a force F over a displacement d = dt v_new gives exactly
//   change of kinetic energy = F.d - m |dv|^2/2,
// so the integrator's own loss is the sum of m |dv|^2/2 plus, for each energy, the gap between its change and
// the work -F.d of the force that stands for it: the convexity gap W_n - W_{n+1} + F.(x_{n+1} - x_n) and the
// splitting of the step, whose two stages move the cloth apart.
#include "sim/time/stepper.h"

#include <cmath>
#include <string>

#include "sim/base/error.h"

namespace hysteron {

namespace {
constexpr int kNewtonWithObstacles = 2;
constexpr int kMostIterations = 2000;
}  // namespace

template <class Real, class Device>
void Stepper<Real, Device>::advance(int steps) {
  const bool adaptive = scene_.tolerance > 0;
  for (int s = 0; s < steps; ++s) {
    carry_out_commands(time(), time() + scene_.step);
    // Stages of this step that end with an implicit solve or, explicit, with the contact's history.
    const int stages = coupled_ ? limits_.substeps : 1;
    if (adaptive && !all_implicit_) adaptive_stages(time());
    for (int k = 0; k < stages && !all_implicit_ && !adaptive; ++k)
      stage(time() + scene_.step * k / stages, static_cast<Real>(scene_.step / stages));
    if (all_implicit_) adaptive ? adaptive_interval(time()) : implicit_interval(time(), scene_.step, 0);
    ++step_count_;
  }
  refuse_divergence();
}

// Commands act on the state accepted last, at the beginning of the step in which they are due.
template <class Real, class Device>
void Stepper<Real, Device>::carry_out_commands(double start, double end) {
  for (const Command& command : scene_.command) {
    if (command.time < start || command.time >= end) continue;
    std::vector<char> chosen;
    for (const Eigen::Vector3d& center : command_center_)
      chosen.push_back(is_in_box(center, command.low, command.high));
    bending_.command(command.kind, chosen);
  }
}

template <class Real, class Device>
void Stepper<Real, Device>::refuse_divergence() {
  const Vec3<Real>*x = x_.data(), *v = v_.data();
  double* size = size_.data();
  for_each_sum<1>(
      *device_, "finite", vertices_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        sums.term[0] += static_cast<double>(x[i].squaredNorm() + v[i].squaredNorm());
      },
      HYST_KERNEL(const Sums<1>& total) { *size = total.term[0]; });
  if (std::isfinite(size_.download()[0])) return;
  throw Error::run("the simulation diverged before t = " + std::to_string(time()) +
                   " s: take a smaller step (step = " + std::to_string(scene_.step) + " s)");
}

template <class Real, class Device>
void Stepper<Real, Device>::stage(double start, Real h) {
  if (with_self_contact_) return self_contact_stage(start, h);
  hold(start, h);
  if (contact_) {
    contact_->move(start, start + static_cast<double>(h));
    remember_positions();
  }
  if (coupled_) {
    gather_impulses(h);
  } else {
    for (int k = 0; k < limits_.substeps; ++k)
      explicit_ ? explicit_substep(h / limits_.substeps) : substep(h / limits_.substeps);
  }
  if (!explicit_) implicit_stage(h);
  if (contact_) commit_contact(start + static_cast<double>(h));
}

// Bending's force is that at the start, also where the step is then taken in parts.
template <class Real, class Device>
void Stepper<Real, Device>::self_contact_stage(double start, Real h) {
  hold(start, h);
  clock_.begin(Stage::bending);
  bending_.commit(x_.data(), v_.data(), h);
  clock_.end(Stage::bending);
  implicit_interval(start, static_cast<double>(h), 0);
}

template <class Real, class Device>
void Stepper<Real, Device>::remember_positions() {
  const Vec3<Real>* x = x_.data();
  Vec3<Real>* before = before_.data();
  for_each(
      *device_, "remember positions", vertices_, HYST_KERNEL(int i) { before[i] = x[i]; });
}

// Hands that take hold or let go at this time or before it.
template <class Real, class Device>
void Stepper<Real, Device>::update_pins(double time) {
  const auto next = std::upper_bound(grip_times_.begin(), grip_times_.end(), time);
  next_grip_ = next == grip_times_.end() ? 1e30 : *next;
  const std::vector<int> pins = cloth_.pins(scene_, time);
  std::vector<char> held;
  for (int p : pins) held.push_back(p >= 0);
  book_grip(held);
  if (contact_) refuse_release(held_.download(), held, time);
  held_.upload(held);
  if (moving_pins_) capture_pins(pins, time);
}

// A hand stops what it takes, and leaves what it lets go in motion: the balance counts no kinetic energy of
// held vertices.
template <class Real, class Device>
void Stepper<Real, Device>::book_grip(const std::vector<char>& held) {
  const std::vector<char> before = held_.download();
  if (held == before) return;
  const std::vector<Vec3<Real>> v = v_.download();
  const std::vector<Real> mass = mass_.download();
  for (int i = 0; i < vertices_; ++i) {
    const double kinetic = static_cast<double>(mass[i]) / 2 * v[i].template cast<double>().squaredNorm();
    if (held[i] != before[i]) grip_work_ += held[i] ? -kinetic : kinetic;
  }
}

// What a hand takes starts where it is.
template <class Real, class Device>
void Stepper<Real, Device>::capture_pins(const std::vector<int>& pins, double time) {
  const std::vector<int> before = pin_.download();
  std::vector<Vec3<Real>> start = start_.download();
  const std::vector<Vec3<Real>> x = x_.download();
  for (int i = 0; i < vertices_; ++i) {
    if (pins[i] < 0 || pins[i] == before[i]) continue;
    const Placement at = placement(scene_.pin[pins[i]].motion, time);
    const Eigen::Vector3d now = x[i].template cast<double>() - at.translation;
    start[i] = (at.rotation.transpose() * now / at.scale).template cast<Real>();
  }
  start_.upload(start);
  pin_.upload(pins);
}

// Held vertices move at the constant velocity that brings them to their place at the end of the step.
template <class Real, class Device>
void Stepper<Real, Device>::hold(double start, Real h) {
  if (start >= next_grip_) update_pins(start);
  if (contact_ && start >= next_obstacle_) meet_obstacles(start);
  if (!moving_pins_) return;
  PinPlacements<Real> placements;
  for (std::size_t p = 0; p < scene_.pin.size(); ++p) {
    const Motion& motion = scene_.pin[p].motion;
    const Placement from = placement(motion, start), at = placement(motion, start + static_cast<double>(h));
    const Eigen::AngleAxisd turn(at.rotation * from.rotation.transpose());
    const double home = home_share(scene_.pin[p], start + static_cast<double>(h));
    placements.home[p] = static_cast<Real>(home);
    placements.homewards[p] = static_cast<Real>(home - home_share(scene_.pin[p], start));
    placements.rotation[p] = (at.scale * at.rotation).template cast<Real>();
    placements.translation[p] = at.translation.template cast<Real>();
    placements.turn[p] = (turn.angle() * turn.axis()).template cast<Real>();
    placements.pivot[p] = at(motion.center).template cast<Real>();
    placements.shift[p] = (at(motion.center) - from(motion.center)).template cast<Real>();
  }
  const int* pin = pin_.data();
  const char* held = held_.data();
  const Vec3<Real>*origin = start_.data(), *home = home_.data(), *x = x_.data();
  Vec3<Real>*v = v_.data(), *way = handle_way_.data();
  for_each(
      *device_, "handles", vertices_, HYST_KERNEL(int i) {
        if (!held[i]) return;
        const int p = pin[i];
        Vec3<Real> from = origin[i], more = Vec3<Real>::Zero();
        if (home) {
          from += placements.home[p] * (home[i] - origin[i]);
          more = placements.homewards[p] * (placements.rotation[p] * (home[i] - origin[i]));
        }
        const Vec3<Real> end = placements.rotation[p] * from + placements.translation[p];
        v[i] = (end - x[i]) / h;
        if (way) way[i] = placements.turn[p].cross(end - placements.pivot[p]) + placements.shift[p] + more;
      });
}

template <class Real, class Device>
void Stepper<Real, Device>::substep(Real dt) {
  clock_.begin(Stage::bending);
  bending_.commit(x_.data(), v_.data(), dt);
  const GatheredForces<Real> bending = bending_.forces();
  const Vec3<Real> g = scene_.gravity.cast<Real>();
  const Real drag = static_cast<Real>(scene_.air_drag / scene_.fabric.density);
  const Real* mass = mass_.data();
  const char* held = held_.data();
  Vec3<Real>*x = x_.data(), *v = v_.data();
  VertexLedger* ledger = ledger_.data();
  for_each(
      *device_, "substep", vertices_, HYST_KERNEL(int i) {
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
        const Vec3<Real> dv = dt / m * (force + weight + air);
        const Vec3<Real> moved = v[i] + dv, d = dt * moved;
        v[i] = moved;
        x[i] += d;
        sum.bending_work += static_cast<double>(force.dot(d));
        sum.gravity_work += static_cast<double>(weight.dot(d));
        sum.air -= static_cast<double>(air.dot(d));
        sum.inertia += static_cast<double>(m / 2 * dv.squaredNorm());
      });
  clock_.end(Stage::bending);
}

// The explicit forces' impulse over h, and the cloth moved on by its velocity: where the implicit stage
// linearises.
template <class Real, class Device>
void Stepper<Real, Device>::gather_impulses(Real h) {
  clock_.begin(Stage::bending);
  bending_.commit(x_.data(), v_.data(), h);
  const GatheredForces<Real> bending = bending_.forces();
  const Vec3<Real> g = scene_.gravity.cast<Real>();
  const Real drag = static_cast<Real>(scene_.air_drag / scene_.fabric.density);
  const Real* mass = mass_.data();
  const Vec3<Real>* v = v_.data();
  Vec3<Real>*x = x_.data(), *impulse = impulse_.data();
  for_each(
      *device_, "explicit impulse", vertices_, HYST_KERNEL(int i) {
        impulse[i] = h * (bending.at(i) + mass[i] * (g - drag * v[i]));
        x[i] += h * v[i];
      });
  clock_.end(Stage::bending);
}

template <class Real, class Device>
void Stepper<Real, Device>::explicit_substep(Real dt) {
  bending_.commit(x_.data(), v_.data(), dt);
  membrane_.update(x_.data(), v_.data());
  const GatheredForces<Real> bending = bending_.forces();
  const MembraneForceView<Real> membrane = membrane_.forces();
  Vec3<Real>* force = rhs_.data();
  for_each(
      *device_, "explicit forces", vertices_, HYST_KERNEL(int i) { force[i] = membrane.at(i); });
  if (contact_) contact_->add(x_.data(), before_.data(), 1, force, nullptr);
  const Vec3<Real> g = scene_.gravity.cast<Real>();
  const Real drag = static_cast<Real>(scene_.air_drag / scene_.fabric.density);
  const Real* mass = mass_.data();
  const char* held = held_.data();
  Vec3<Real>*x = x_.data(), *v = v_.data();
  VertexLedger* ledger = ledger_.data();
  for_each(
      *device_, "explicit substep", vertices_, HYST_KERNEL(int i) {
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

// rhs = explicit impulse + h (f_m + f_d + f_c) - M dv, matrix = M + h^2 K + h D at the present iterate.
template <class Real, class Device>
void Stepper<Real, Device>::linear_system(Real h, bool first) {
  clock_.begin(Stage::membrane);
  membrane_.update(x_.data(), v_.data());
  const BlockRowsView<Real> matrix = matrix_.view();
  membrane_.assemble(h * h + h * membrane_.damping(), h * h, matrix);
  const MembraneForceView<Real> force = membrane_.forces();
  const Real* mass = mass_.data();
  const bool together = coupled_;
  const Vec3<Real>*total = change_.data(), *impulse = impulse_.data();
  Vec3<Real>* rhs = rhs_.data();
  for_each(
      *device_, "implicit forces", vertices_, HYST_KERNEL(int i) {
        rhs[i] = h * force.at(i);
        if (together) rhs[i] += impulse[i];
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
void Stepper<Real, Device>::implicit_stage(Real h) {
  const int newton = contact_ ? kNewtonWithObstacles : 1;
  for (int iteration = 0; iteration < newton; ++iteration) {
    linear_system(h, iteration == 0);
    clock_.begin(Stage::solve);
    const PcgOutcome outcome =
        pcg_.solve({matrix_.view()}, held_.data(), rhs_.data(), coupled_ ? impulse_.data() : nullptr,
                   iteration == 0 ? change_.data() : nullptr, correction_.data(), scene_.solver_tolerance,
                   kMostIterations);
    solver_iterations_ += outcome.iterations;
    const Vec3<Real>* dv = correction_.data();
    Vec3<Real>*x = x_.data(), *v = v_.data(), *total = change_.data();
    const char* held = held_.data();
    const bool first = iteration == 0;
    for_each(
        *device_, "correct", vertices_, HYST_KERNEL(int i) {
          if (held[i]) return;
          total[i] = first ? dv[i] : Vec3<Real>(total[i] + dv[i]);
          v[i] += dv[i];
          x[i] += h * dv[i];
        });
    clock_.end(Stage::solve);
  }
  accept_implicit(h);
  membrane_.add_viscous_loss(v_.data(), h);
}

// The impulse that really acted is M dv, whatever the linearisation and the solver's tolerance made of it.
// The impulse on a held vertex is that of the last linear system: rhs - matrix dv, without the mass because
// its own dv is 0.
template <class Real, class Device>
void Stepper<Real, Device>::accept_implicit(Real h) {
  const Real* mass = mass_.data();
  const char* held = held_.data();
  const Vec3<Real>*v = v_.data(), *total = change_.data(), *rhs = rhs_.data(), *last = correction_.data();
  const Vec3<Real>* explicit_impulse = impulse_.data();
  const BlockRowsView<Real> matrix = matrix_.view();
  const GatheredForces<Real> bending = bending_.forces();
  const Vec3<Real> g = scene_.gravity.cast<Real>();
  const bool handles = moving_pins_, together = coupled_;
  VertexLedger* ledger = ledger_.data();
  for_each(
      *device_, "implicit ledger", vertices_, HYST_KERNEL(int i) {
        if (held[i] && !handles) return;
        VertexLedger& sum = ledger[i];
        Vec3<Real> impulse =
            held[i] ? Vec3<Real>(rhs[i] - matrix.times(i, last)) : Vec3<Real>(mass[i] * total[i]);
        if (!held[i]) sum.inertia += static_cast<double>(mass[i] / 2 * total[i].squaredNorm());
        if (together) {
          const Vec3<Real> bend = bending.at(i), weight = mass[i] * g, d = h * v[i];
          sum.bending_work += static_cast<double>(bend.dot(d));
          sum.gravity_work += static_cast<double>(weight.dot(d));
          if (held[i])
            sum.handle_work -= static_cast<double>((bend + weight).dot(d));
          else
            sum.air -= static_cast<double>((explicit_impulse[i] - h * (bend + weight)).dot(v[i]));
          impulse -= explicit_impulse[i];
        }
        const double work = static_cast<double>(impulse.dot(v[i]));
        sum.implicit_work += work;
        if (held[i]) sum.handle_work -= work;
      });
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
