// The step of hi = alpha he (Wong, Leach, Zambetta 2013, 4.3; Schroeder et al. 2011) takes bending
// explicitly, and tension, damping and contact implicitly, with alpha the least number of substeps for which
// explicit bending is stable.
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
// energy in; and bending waves whose period resonates with hi grow unless viscosity damps them.  If they act
// together, the cloth rests exactly.
//
// With self-contact the implicit part is solved to the end, as a minimum problem whose line search and
// collision detection keep layers apart (implicit_integrator.h); bending stays explicit.
//
// The ledger: each velocity change dv under a force F over a displacement d = dt v_new gives exactly
//   change of kinetic energy = F.d - m |dv|^2/2,
// so the integrator's own loss is the sum of m |dv|^2/2 plus, for each energy, the gap between its change and
// the work -F.d of the force that stands for it: the convexity gap W_n - W_{n+1} + F.(x_{n+1} - x_n) and the
// splitting of the step, whose two stages move the cloth apart.
#include "sim/time/semi_implicit.h"

#include <algorithm>
#include <cmath>

#include "sim/time/time_integrator.h"

namespace hysteron {

namespace {
constexpr int kMaxIterations = 2000;

// Returns the accuracy [m] beyond which positions of cloth that starts so need not be solved for.  The
// rounding of positions causes a force through the stiffness that holds them, another in each step; a
// hundredth of that moves a hanging cloth by less than single precision does.  In double precision no solve
// comes near it.
template <class Real>
double rounding_allowance(const std::vector<Eigen::Vector3d>& start) {
  constexpr double kRounding = sizeof(Real) == 8 ? 0 : 6e-8, kRoundingFraction = 0.01;
  double reach = 0;
  for (const Eigen::Vector3d& p : start) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  return kRoundingFraction * kRounding * reach;
}
}  // namespace

template <class Real, class Device>
SemiImplicit<Real, Device>::SemiImplicit(Body<Real, Device>& body, const StepLimits& limits)
    : TimeIntegrator<Real, Device>(body),
      limits_(limits),
      blur_(rounding_allowance<Real>(body.cloth.start)),
      pcg_(*body.device, body.vertices),
      change_(*body.device, body.vertices),
      correction_(*body.device, body.vertices),
      rhs_(*body.device, body.vertices),
      impulse_(*body.device, body.scene.implicit_every == ImplicitEvery::substep ? body.vertices : 0),
      size_(*body.device, 1) {}

template <class Real, class Device>
void SemiImplicit<Real, Device>::step(double start, double h) {
  this->refuse_longer(h);
  if (body_.scene.implicit_every == ImplicitEvery::step) return take_chapter_step(start, h);
  if (body_.scene.tolerance > 0) return take_adaptive_step(start, h);
  const int stages = limits_.substeps;
  for (int k = 0; k < stages; ++k) stage(start + h * k / stages, static_cast<Real>(h / stages));
}

template <class Real, class Device>
void SemiImplicit<Real, Device>::stage(double start, Real h) {
  body_.begin_stage(start, h);
  gather_impulses(h);
  solve(h, impulse_.data());
  body_.end_stage(start + static_cast<double>(h));
}

// Takes steps that cannot be taken back: the error of one sets the length of the next.
template <class Real, class Device>
void SemiImplicit<Real, Device>::take_adaptive_step(double start, double whole) {
  const Scene& scene = body_.scene;
  const double end = start + whole, largest = limits_.substep, least = whole / (1 << kMaxHalvings);
  if (part_ <= 0) part_ = std::min(largest, whole / 16);
  for (double now = start; end - now > least / 2;) {
    const double h = equal_part(end - now, std::min(part_, largest));
    stage(now, static_cast<Real>(h));
    ++body_.counts.parts;
    now += h;
    // x_n + h v_n misses by h dv; half of that is the error of a first-order step.
    const double error = h * change_size() / 2;
    part_ = std::max(least, next_part(h, std::sqrt(scene.tolerance / error)));
  }
}

template <class Real, class Device>
void SemiImplicit<Real, Device>::gather_impulses(Real h) {
  body_.clock.begin(Stage::bending);
  body_.bending.commit(body_.x.data(), body_.v.data(), h);
  const GatheredForces<Real> bending = body_.bending.forces();
  const Vec3<Real> g = body_.gravity();
  const Real drag = body_.drag();
  const Real* mass = body_.mass.data();
  const Vec3<Real>* v = body_.v.data();
  Vec3<Real>*x = body_.x.data(), *impulse = impulse_.data();
  const std::size_t bytes =
      body_.bending.force_bytes() + total_bytes(body_.mass, body_.v, body_.x, body_.x, impulse_);
  for_each(
      *body_.device, {"explicit impulse", bytes}, body_.vertices, HYST_KERNEL(int i) {
        impulse[i] = h * (bending.at(i) + mass[i] * (g - drag * v[i]));
        x[i] += h * v[i];
      });
  body_.clock.end(Stage::bending);
}

template <class Real, class Device>
void SemiImplicit<Real, Device>::take_chapter_step(double start, double whole) {
  const Real h = static_cast<Real>(whole);
  body_.begin_stage(start, h);
  for (int k = 0; k < limits_.substeps; ++k) substep(h / limits_.substeps);
  solve(h, nullptr);
  body_.end_stage(start + static_cast<double>(h));
}

template <class Real, class Device>
void SemiImplicit<Real, Device>::substep(Real dt) {
  body_.clock.begin(Stage::bending);
  body_.bending.commit(body_.x.data(), body_.v.data(), dt);
  const GatheredForces<Real> bending = body_.bending.forces();
  const Vec3<Real> g = body_.gravity();
  const Real drag = body_.drag();
  const Real* mass = body_.mass.data();
  const char* held = body_.held.data();
  Vec3<Real>*x = body_.x.data(), *v = body_.v.data();
  VertexLedger* ledger = body_.ledger.data();
  const std::size_t bytes =
      body_.bending.force_bytes() +
      total_bytes(body_.mass, body_.held, body_.x, body_.x, body_.v, body_.v, body_.ledger, body_.ledger);
  for_each(
      *body_.device, {"substep", bytes}, body_.vertices, HYST_KERNEL(int i) {
        const Vec3<Real> force = bending.at(i);
        const Real m = mass[i];
        const Vec3<Real> weight = m * g;
        VertexLedger& sum = ledger[i];
        if (held[i]) {
          const Vec3<Real> d = dt * v[i];
          sum.pin_work -= static_cast<double>((force + weight).dot(d));
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
  body_.clock.end(Stage::bending);
}

template <class Real, class Device>
void SemiImplicit<Real, Device>::solve(Real h, const Vec3<Real>* impulse) {
  constexpr int kNewtonWithObstacles = 2;
  const int newton = body_.contact ? kNewtonWithObstacles : 1;
  const double blur = blur_ / static_cast<double>(h + body_.membrane.damping());  // [m/s]
  for (int iteration = 0; iteration < newton; ++iteration) {
    const bool first = iteration == 0;
    assemble(h, impulse, first);
    body_.clock.begin(Stage::solve);
    LinearSystem<Real, Device> system{body_.matrix.view()};
    system.bytes = body_.matrix.bytes();
    system.mass = body_.mass.data();
    const PcgOutcome outcome =
        pcg_.solve(system, body_.held.data(), rhs_.data(), impulse, first ? change_.data() : nullptr,
                   correction_.data(), {body_.scene.solver_tolerance, kMaxIterations, blur});
    body_.counts.linear += outcome.iterations;
    correct(h, first);
    body_.clock.end(Stage::solve);
  }
  update_ledger(h, impulse);
  body_.membrane.add_viscous_loss(body_.v.data(), h);
  body_.membrane.commit_friction(body_.x.data());
}

// Sets rhs = explicit impulse + h (f_m + f_d + f_c) - M dv and matrix = M + h^2 K + h D at the present
// iterate.
template <class Real, class Device>
void SemiImplicit<Real, Device>::assemble(Real h, const Vec3<Real>* impulse, bool first) {
  body_.clock.begin(Stage::membrane);
  body_.membrane.update(body_.x.data(), body_.v.data());
  const BlockRowsView<Real> matrix = body_.matrix.view();
  body_.membrane.assemble(h * h + h * body_.membrane.damping(), h * h, matrix);
  const MembraneForceView<Real> force = body_.membrane.forces();
  const Real* mass = body_.mass.data();
  const Vec3<Real>* total = change_.data();
  Vec3<Real>* rhs = rhs_.data();
  const std::size_t diagonal = 2 * body_.vertices * sizeof(Mat3<Real>),  // read and written
      vectors = (1 + (impulse ? 1 : 0) + (first ? 0 : 1)) * rhs_.bytes();
  for_each(
      *body_.device,
      {"implicit forces", body_.membrane.force_bytes() + body_.mass.bytes() + diagonal + vectors},
      body_.vertices, HYST_KERNEL(int i) {
        rhs[i] = h * force.at(i);
        if (impulse) rhs[i] += impulse[i];
        if (!first) rhs[i] -= mass[i] * total[i];
        for (int k = 0; k < 3; ++k) matrix.diagonal[i](k, k) += mass[i];
      });
  body_.clock.end(Stage::membrane);
  if (!body_.contact) return;
  body_.clock.begin(Stage::contact);
  body_.contact->add(body_.x.data(), body_.before.data(), h, rhs, &matrix);
  body_.clock.end(Stage::contact);
}

template <class Real, class Device>
void SemiImplicit<Real, Device>::correct(Real h, bool first) {
  const Vec3<Real>* dv = correction_.data();
  Vec3<Real>*x = body_.x.data(), *v = body_.v.data(), *total = change_.data();
  const char* held = body_.held.data();
  const std::size_t bytes = total_bytes(correction_, change_, body_.v, body_.v, body_.x, body_.x, body_.held);
  for_each(
      *body_.device, {"correct", bytes}, body_.vertices, HYST_KERNEL(int i) {
        if (held[i]) return;
        total[i] = first ? dv[i] : Vec3<Real>(total[i] + dv[i]);
        v[i] += dv[i];
        x[i] += h * dv[i];
      });
}

// Books energies.  The impulse that really acted is M dv, whatever the errors of the linearisation and the
// solver.  The impulse on a held vertex is that of the last linear system: rhs - matrix dv, without the mass
// because its own dv is 0.
template <class Real, class Device>
void SemiImplicit<Real, Device>::update_ledger(Real h, const Vec3<Real>* explicit_impulse) {
  const Real* mass = body_.mass.data();
  const char* held = body_.held.data();
  const Vec3<Real>*v = body_.v.data(), *total = change_.data(), *rhs = rhs_.data(),
        *last = correction_.data();
  const BlockRowsView<Real> matrix = body_.matrix.view();
  const GatheredForces<Real> bending = body_.bending.forces();
  const Vec3<Real> g = body_.gravity();
  const bool pins_move = body_.pins.any_moves();
  VertexLedger* ledger = body_.ledger.data();
  const std::size_t explicit_bytes = explicit_impulse ? body_.bending.force_bytes() + rhs_.bytes() : 0;
  for_each(
      *body_.device,
      {"implicit ledger",
       explicit_bytes + total_bytes(body_.mass, body_.held, body_.v, change_, body_.ledger, body_.ledger)},
      body_.vertices, HYST_KERNEL(int i) {
        if (held[i] && !pins_move) return;
        VertexLedger& sum = ledger[i];
        Vec3<Real> impulse =
            held[i] ? Vec3<Real>(rhs[i] - matrix.times(i, last)) : Vec3<Real>(mass[i] * total[i]);
        if (!held[i]) sum.inertia += static_cast<double>(mass[i] / 2 * total[i].squaredNorm());
        if (explicit_impulse) {
          const Vec3<Real> bend = bending.at(i), weight = mass[i] * g, d = h * v[i];
          sum.bending_work += static_cast<double>(bend.dot(d));
          sum.gravity_work += static_cast<double>(weight.dot(d));
          if (held[i])
            sum.pin_work -= static_cast<double>((bend + weight).dot(d));
          else
            sum.air -= static_cast<double>((explicit_impulse[i] - h * (bend + weight)).dot(v[i]));
          impulse -= explicit_impulse[i];
        }
        const double work = static_cast<double>(impulse.dot(v[i]));
        sum.implicit_work += work;
        if (held[i]) sum.pin_work -= work;
      });
}

template <class Real, class Device>
double SemiImplicit<Real, Device>::change_size() {
  const Real* mass = body_.mass.data();
  const char* held = body_.held.data();
  const Vec3<Real>* dv = change_.data();
  double* size = size_.data();
  for_each_sum<2>(
      *body_.device, {"velocity change", total_bytes(body_.mass, body_.held, change_)}, body_.vertices,
      HYST_KERNEL(int i, Sums<2>& sums) {
        sums.term[1] += static_cast<double>(mass[i]);
        if (!held[i]) sums.term[0] += static_cast<double>(mass[i] * dv[i].squaredNorm());
      },
      HYST_KERNEL(const Sums<2>& total) { *size = total.term[0] / total.term[1]; });
  return std::sqrt(size_.download()[0]);
}

template class SemiImplicit<double, ThisDevice>;
template class SemiImplicit<float, ThisDevice>;

template <class Real, class Device>
ExplicitEuler<Real, Device>::ExplicitEuler(Body<Real, Device>& body, const StepLimits& limits)
    : TimeIntegrator<Real, Device>(body), substeps_(limits.substeps), force_(*body.device, body.vertices) {}

template <class Real, class Device>
void ExplicitEuler<Real, Device>::step(double start, double whole) {
  this->refuse_longer(whole);
  const Real h = static_cast<Real>(whole);
  body_.begin_stage(start, h);
  for (int k = 0; k < substeps_; ++k) substep(h / substeps_);
  body_.end_stage(start + static_cast<double>(h));
}

template <class Real, class Device>
void ExplicitEuler<Real, Device>::substep(Real dt) {
  body_.bending.commit(body_.x.data(), body_.v.data(), dt);
  body_.membrane.update(body_.x.data(), body_.v.data());
  const GatheredForces<Real> bending = body_.bending.forces();
  const MembraneForceView<Real> membrane = body_.membrane.forces();
  Vec3<Real>* force = force_.data();
  for_each(
      *body_.device, {"explicit forces", body_.membrane.force_bytes() + force_.bytes()}, body_.vertices,
      HYST_KERNEL(int i) { force[i] = membrane.at(i); });
  if (body_.contact) body_.contact->add(body_.x.data(), body_.before.data(), 1, force, nullptr);
  const Vec3<Real> g = body_.gravity();
  const Real drag = body_.drag();
  const Real* mass = body_.mass.data();
  const char* held = body_.held.data();
  Vec3<Real>*x = body_.x.data(), *v = body_.v.data();
  VertexLedger* ledger = body_.ledger.data();
  const std::size_t bytes =
      body_.bending.force_bytes() + total_bytes(force_, body_.mass, body_.held, body_.x, body_.x, body_.v,
                                                body_.v, body_.ledger, body_.ledger);
  for_each(
      *body_.device, {"explicit substep", bytes}, body_.vertices, HYST_KERNEL(int i) {
        const Vec3<Real> bend = bending.at(i), other_force = force[i], weight = mass[i] * g;
        VertexLedger& sum = ledger[i];
        const Vec3<Real> air = held[i] ? Vec3<Real>(Vec3<Real>::Zero()) : Vec3<Real>(-drag * mass[i] * v[i]);
        if (!held[i]) {
          const Vec3<Real> dv = dt / mass[i] * (bend + other_force + weight + air);
          v[i] += dv;
          sum.inertia += static_cast<double>(mass[i] / 2 * dv.squaredNorm());
        }
        const Vec3<Real> d = dt * v[i];
        x[i] += d;
        sum.bending_work += static_cast<double>(bend.dot(d));
        sum.gravity_work += static_cast<double>(weight.dot(d));
        sum.implicit_work += static_cast<double>(other_force.dot(d));
        sum.air -= static_cast<double>(air.dot(d));
        if (held[i]) sum.pin_work -= static_cast<double>((bend + other_force + weight).dot(d));
      });
  body_.membrane.add_viscous_loss(body_.v.data(), dt);
  body_.membrane.commit_friction(body_.x.data());
}

template class ExplicitEuler<double, ThisDevice>;
template class ExplicitEuler<float, ThisDevice>;

}  // namespace hysteron
