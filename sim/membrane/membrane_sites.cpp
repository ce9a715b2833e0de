#include "sim/membrane/membrane_sites.h"

namespace hysteron {

namespace {

template <class Real>
std::vector<StrainStop<Real>> all_stops(const InPlaneStops& stops) {
  std::vector<StrainStop<Real>> all;
  for (const Spectrum* of : {&stops.warp, &stops.weft, &stops.shear})
    for (std::size_t j = 0; j < of->size(); ++j)
      all.push_back({static_cast<Real>(of->thresholds[j]), static_cast<Real>(of->stiffnesses[j])});
  return all;
}

template <class Real>
HYST_HD MembraneStress<Real> stress_sum(const MembraneStress<Real>& a, const Vec3<Real>& b) {
  return {a.s11 + b[0], a.s22 + b[1], a.s12 + b[2]};
}

}  // namespace

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
      end_{static_cast<int>(stops.warp.size()), static_cast<int>(stops.warp.size() + stops.weft.size()),
           static_cast<int>(stops.warp.size() + stops.weft.size() + stops.shear.size())},
      growth_(static_cast<Real>(stops.shear_growth)),
      stop_(device, all_stops<Real>(stops)),
      slip_(device, static_cast<std::size_t>(sites) * end_[2]),
      tangent_(device, has_friction() ? sites : 0),
      lost_(device, has_friction() ? sites : 0) {}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::update(const Vec3<Real>* x, const Vec3<Real>* v) {
  const MembraneStiffness<Real> c = stiffness_;
  const Real damping = damping_;
  const Strains of = strains_;
  const bool projects = is_last_ && !has_friction();
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
  if (has_friction()) add_friction(nullptr);
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
  if (has_friction()) add_friction(energy);
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::add_viscous_loss() {
  const Real viscous = viscous_factor();
  if (!(viscous > 0)) return;
  const MembraneStiffness<Real> c = stiffness_;
  // The loss is dt damping dE/dt C dE/dt.
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
  if (has_friction()) add_stored_friction(x, energy);
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::add_friction(double* energy) {
  const StrainStops<Real> stops = this->stops();
  const Strains of = strains_;
  const bool projects = is_last_;
  MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  Vec3<Real>* tangent = tangent_.data();
  for_each(
      device_, {energy ? "membrane friction, tried" : "membrane friction", total_bytes(slip_, tangent_)},
      sites_, HYST_KERNEL(int i) {
        const StopsReply<Real> now = stops.reply(i, of.evaluated(i));
        const MembraneStress<Real> all = stress_sum(stress[i], now.stress);
        stress[i] = all;
        if (energy) {
          if (projects) tension[i] = tensile_part(all);
          energy[i] += static_cast<double>(of.area(i) * (now.stored + now.lost));
        } else {
          const MembraneStress<Real> pulls = stress_sum(tension[i], now.stress);
          tension[i] = projects ? tensile_part(pulls) : pulls;
        }
        tangent[i] = now.tangent;
      });
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::add_stored_friction(const Vec3<Real>* x, double* energy) {
  const StrainStops<Real> stops = this->stops();
  const Strains of = strains_;
  for_each(
      device_, "membrane friction energy", sites_, HYST_KERNEL(int i) {
        energy[i] += static_cast<double>(of.area(i) * stops.reply(i, of.at(i, x)).stored);
      });
}

template <class Strains, class Device>
void MembraneSites<Strains, Device>::commit_friction(const Vec3<Real>* x, bool is_start) {
  if (!has_friction()) return;
  const StrainStops<Real> stops = this->stops();
  const Strains of = strains_;
  double* lost = lost_.data();
  for_each(
      device_, {"membrane history", total_bytes(slip_, lost_)}, sites_, HYST_KERNEL(int i) {
        const Vec3<Real> strain = of.at(i, x);
        if (!is_start) lost[i] += static_cast<double>(of.area(i) * stops.reply(i, strain).lost);
        stops.accept(i, strain);
      });
}

template class MembraneSites<FaceStrains<double>, ThisDevice>;
template class MembraneSites<FaceStrains<float>, ThisDevice>;
template class MembraneSites<NodeStrains<double>, ThisDevice>;
template class MembraneSites<NodeStrains<float>, ThisDevice>;

}  // namespace hysteron
