#include "sim/membrane/membrane_sites.h"

#include <cmath>
#include <numeric>

namespace hysteron {

template <class Strains, class Device>
MembraneSites<Strains, Device>::MembraneSites(Device& device, const Strains& strains, int sites,
                                              const MembraneStiffness<double>& stiffness, double damping,
                                              const InPlaneStops& stops, bool is_last, Bytes bytes)
    : device_(device),
      strains_(strains),
      sites_(sites),
      stiffness_{static_cast<Real>(stiffness.warp), static_cast<Real>(stiffness.weft),
                 static_cast<Real>(stiffness.coupling), static_cast<Real>(stiffness.shear)},
      damping_(static_cast<Real>(damping)),
      is_last_(is_last),
      bytes_(bytes),
      stress_(device, sites),
      tension_(device, sites),
      viscous_(device, damping > 0 ? sites : 0),
      friction_(device, stops, sites) {}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::update(const Vec3<Real>* x, const Vec3<Real>* v) {
  const MembraneStiffness<Real> c = stiffness_;
  const Real damping = damping_;
  const Strains of = strains_;
  const bool projects = is_last_ && !friction_.any();
  MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  for_each(
      device_,
      {"membrane stress",
       bytes_.strains + (damping > 0 ? bytes_.vectors : 0) + total_bytes(stress_, tension_)},
      sites_, HYST_KERNEL(int i) {
        Vec3<Real> strain = of.evaluate(i, x);
        const MembraneStress<Real> elastic = membrane_stress(c, strain);
        tension[i] = projects ? tensile_part(elastic) : elastic;
        if (damping > 0) strain += damping * of.rate(i, v);
        stress[i] = membrane_stress(c, strain);
      });
  if (friction_.any()) friction_.add(strains_, stresses());
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::begin_step(const StepFormula& formula, const Vec3<Real>* now,
                                                const Vec3<Real>* before) {
  formula_ = formula;
  if (damping_ <= 0) return;
  if (reference_.size() == 0) reference_ = Buffer<Vec3<Real>, Device>(device_, sites_);
  const Real extrapolation = static_cast<Real>(formula.extrapolation);
  const Strains of = strains_;
  Vec3<Real>* reference = reference_.data();
  for_each(
      device_,
      {"membrane reference",
       bytes_.strains + (extrapolation > 0 ? bytes_.vectors : 0) + total_bytes(reference_)},
      sites_, HYST_KERNEL(int i) {
        const Vec3<Real> last = of.at(i, now);
        reference[i] = last;
        if (extrapolation > 0) reference[i] += extrapolation * (last - of.at(i, before));
      });
}

template <class Strains, class Device>
typename Strains::Real MembraneSites<Strains, Device>::viscous_factor() const {
  return std::isfinite(formula_.beta_dt) ? damping_ / static_cast<Real>(formula_.beta_dt) : Real(0);
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::evaluate(const Vec3<Real>* x, double* energy) {
  const MembraneStiffness<Real> c = stiffness_;
  const Real viscous = viscous_factor();
  const Strains of = strains_;
  const bool projects = is_last_;
  const Vec3<Real>* reference = reference_.data();
  MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  for_each(
      device_,
      {"membrane stress, tried",
       bytes_.strains + total_bytes(reference_, stress_, tension_) + sites_ * sizeof(double)},
      sites_, HYST_KERNEL(int i) {
        Vec3<Real> strain = of.evaluate(i, x);
        Real potential = membrane_energy(c, strain);
        if (viscous > 0) {
          const Vec3<Real> change = strain - reference[i];
          potential += viscous * membrane_energy(c, change);
          strain += viscous * change;
        }
        const MembraneStress<Real> all = membrane_stress(c, strain);
        stress[i] = all;
        tension[i] = projects ? tensile_part(all) : all;
        energy[i] = static_cast<double>(of.area(i) * potential);
      });
  if (friction_.any()) friction_.add_to_trial(strains_, stresses(), energy);
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::add_viscous_loss() {
  const Real viscous = viscous_factor();
  if (!(viscous > 0)) return;
  const MembraneStiffness<Real> c = stiffness_;
  // dt damping dE/dt C dE/dt
  const Real factor = 2 * viscous * static_cast<Real>(formula_.dt / formula_.beta_dt);
  const Strains of = strains_;
  const Vec3<Real>* reference = reference_.data();
  double* lost = viscous_.data();
  for_each(
      device_, {"viscous loss", bytes_.strains + total_bytes(reference_, viscous_, viscous_)}, sites_,
      HYST_KERNEL(int i) {
        const Vec3<Real> change = of.evaluated(i) - reference[i];
        lost[i] += static_cast<double>(factor * of.area(i) * membrane_energy(c, change));
      });
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::add_viscous_loss(const Vec3<Real>* v, Real step) {
  if (damping_ <= 0) return;
  const MembraneStiffness<Real> c = stiffness_;
  const Real factor = 2 * step * damping_;  // the rate form e'Ce' is twice membrane_energy(e')
  const Strains of = strains_;
  double* lost = viscous_.data();
  for_each(
      device_, {"viscous loss", bytes_.strains + total_bytes(viscous_, viscous_)}, sites_,
      HYST_KERNEL(int i) {
        lost[i] += static_cast<double>(factor * of.area(i) * membrane_energy(c, of.rate(i, v)));
      });
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::find_stored(const Vec3<Real>* x, double* energy) {
  const MembraneStiffness<Real> c = stiffness_;
  const Strains of = strains_;
  for_each(
      device_, "membrane energy", sites_,
      HYST_KERNEL(int i) { energy[i] = static_cast<double>(of.area(i) * membrane_energy(c, of.at(i, x))); });
  if (friction_.any()) friction_.add_stored(strains_, x, energy);
}

template <class Strains, class Device>
double MembraneSites<Strains, Device>::viscous_loss() const {
  const std::vector<double> values = viscous_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::commit_friction(const Vec3<Real>* x, bool is_start) {
  if (friction_.any()) friction_.commit(strains_, x, is_start);
}

template class MembraneSites<FaceStrains<double>, ThisDevice>;
template class MembraneSites<FaceStrains<float>, ThisDevice>;
template class MembraneSites<NodeStrains<double>, ThisDevice>;
template class MembraneSites<NodeStrains<float>, ThisDevice>;

}  // namespace hysteron
