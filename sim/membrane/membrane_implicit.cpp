// The membrane in an implicit step: elastic energy W(E), friction's potential (strain_stops.h), and viscosity
// as the potential
//   damping/beta_dt * W(E - E_ref),   whose stress is damping * C dE/dt with dE/dt = (E - E_ref)/beta_dt,
// so that a step is a minimum problem and rotations cost nothing.
#include <cmath>

#include "sim/membrane/membrane.h"

namespace hysteron {

template <class Real, class Device>
void Membrane<Real, Device>::begin_step(const StepFormula& formula, const Vec3<Real>* now,
                                        const Vec3<Real>* before) {
  formula_ = formula;
  if (damping_ <= 0) return;
  if (reference_.size() == 0) reference_ = Buffer<Vec3<Real>, Device>(device_, faces_);
  const Real extrapolation = static_cast<Real>(formula.extrapolation);
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  Vec3<Real>* reference = reference_.data();
  for_each(
      device_,
      {"membrane reference",
       bytes_of(rest_, corner_, reference_) + (extrapolation > 0 ? 2 : 1) * vertex_bytes()},
      faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Vec3<Real> last = green_strain(deformation(rest[f], now[t[0]], now[t[1]], now[t[2]]));
        reference[f] = last;
        if (extrapolation > 0)
          reference[f] +=
              extrapolation *
              (last - green_strain(deformation(rest[f], before[t[0]], before[t[1]], before[t[2]])));
      });
}

template <class Real, class Device>
Real Membrane<Real, Device>::viscous_factor() const {
  return std::isfinite(formula_.beta_dt) ? damping_ / static_cast<Real>(formula_.beta_dt) : Real(0);
}

template <class Real, class Device>
void Membrane<Real, Device>::evaluate(const Vec3<Real>* x) {
  const MembraneStiffness<Real> c = stiffness_;
  const Real viscous = viscous_factor();
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  const Vec3<Real>* reference = reference_.data();
  Deformation<Real>* deformed = deformation_.data();
  MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  double* energy = measure_.data();
  for_each(
      device_,
      {"membrane stress, tried",
       bytes_of(rest_, corner_, reference_, deformation_, stress_, tension_, measure_) + vertex_bytes()},
      faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Deformation<Real> d = deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]);
        Vec3<Real> strain = green_strain(d);
        Real potential = membrane_energy(c, strain);
        if (viscous > 0) {
          const Vec3<Real> change = strain - reference[f];
          potential += viscous * membrane_energy(c, change);
          strain += viscous * change;
        }
        deformed[f] = d;
        stress[f] = membrane_stress(c, strain);
        tension[f] = tensile_part(stress[f]);
        energy[f] = static_cast<double>(rest[f].area * potential);
      });
  if (friction_.any()) friction_.add_to_trial(stressed(), energy);
}

template <class Real, class Device>
void Membrane<Real, Device>::add_viscous_loss() {
  const Real viscous = viscous_factor();
  if (!(viscous > 0)) return;
  const MembraneStiffness<Real> c = stiffness_;
  // dt damping dE/dt C dE/dt
  const Real factor = 2 * viscous * static_cast<Real>(formula_.dt / formula_.beta_dt);
  const MembraneRest<Real>* rest = rest_.data();
  const Deformation<Real>* deformed = deformation_.data();
  const Vec3<Real>* reference = reference_.data();
  double* lost = viscous_.data();
  for_each(
      device_, {"viscous loss", bytes_of(rest_, deformation_, reference_, viscous_, viscous_)}, faces_,
      HYST_KERNEL(int f) {
        const Vec3<Real> change = green_strain(deformed[f]) - reference[f];
        lost[f] += static_cast<double>(factor * rest[f].area * membrane_energy(c, change));
      });
}

template class Membrane<double, ThisDevice>;
template class Membrane<float, ThisDevice>;

}  // namespace hysteron
