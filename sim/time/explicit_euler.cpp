#include "sim/time/explicit_euler.h"

namespace hysteron {

template <class Real, class Device>
ExplicitEuler<Real, Device>::ExplicitEuler(Body<Real, Device>& body, const StepLimits& limits)
    : body_(body), substeps_(limits.substeps), force_(*body.device, body.vertices) {}

template <class Real, class Device>
void ExplicitEuler<Real, Device>::step(double start) {
  const Real h = static_cast<Real>(body_.scene.step);
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
  const Vec3<Real> g = body_.scene.gravity.template cast<Real>();
  const Real drag = static_cast<Real>(body_.scene.air_drag / body_.scene.fabric.density);
  const Real* mass = body_.mass.data();
  const char* held = body_.held.data();
  Vec3<Real>*x = body_.x.data(), *v = body_.v.data();
  VertexLedger* ledger = body_.ledger.data();
  const std::size_t bytes =
      body_.bending.force_bytes() + bytes_of(force_, body_.mass, body_.held, body_.x, body_.x, body_.v,
                                             body_.v, body_.ledger, body_.ledger);
  for_each(
      *body_.device, {"explicit substep", bytes}, body_.vertices, HYST_KERNEL(int i) {
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
  body_.membrane.add_viscous_loss(body_.v.data(), dt);
  body_.membrane.commit_friction(body_.x.data());
}

template class ExplicitEuler<double, ThisDevice>;
template class ExplicitEuler<float, ThisDevice>;

}  // namespace hysteron
