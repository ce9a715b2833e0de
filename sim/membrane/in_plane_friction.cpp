#include "sim/membrane/in_plane_friction.h"

#include <numeric>

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
InPlaneFriction<Strains, Device>::InPlaneFriction(Device& device, const InPlaneStops& stops, int sites)
    : device_(device),
      sites_(sites),
      end_{static_cast<int>(stops.warp.size()), static_cast<int>(stops.warp.size() + stops.weft.size()),
           static_cast<int>(stops.warp.size() + stops.weft.size() + stops.shear.size())},
      stop_(device, all_stops<Real>(stops)),
      slip_(device, static_cast<std::size_t>(sites) * end_[2]),
      tangent_(device, any() ? sites : 0),
      lost_(device, any() ? sites : 0) {}

template <class Strains, class Device>
void InPlaneFriction<Strains, Device>::add(const Strains& strains, const SiteStresses<Real>& to) {
  const StrainStops<Real> stops = view();
  const Strains of = strains;
  const SiteStresses<Real> sites = to;
  Vec3<Real>* tangent = tangent_.data();
  for_each(
      device_, {"membrane friction", total_bytes(slip_, tangent_)}, sites_, HYST_KERNEL(int i) {
        const StopsReply<Real> now = stops.reply(i, of.evaluated(i));
        sites.stress[i] = stress_sum(sites.stress[i], now.stress);
        const MembraneStress<Real> tension = stress_sum(sites.tension[i], now.stress);
        sites.tension[i] = sites.projects ? tensile_part(tension) : tension;
        tangent[i] = now.tangent;
      });
}

template <class Strains, class Device>
void InPlaneFriction<Strains, Device>::add_to_trial(const Strains& strains, const SiteStresses<Real>& to,
                                                    double* energy) {
  const StrainStops<Real> stops = view();
  const Strains of = strains;
  const SiteStresses<Real> sites = to;
  Vec3<Real>* tangent = tangent_.data();
  for_each(
      device_, {"membrane friction, tried", total_bytes(slip_, tangent_)}, sites_, HYST_KERNEL(int i) {
        const StopsReply<Real> now = stops.reply(i, of.evaluated(i));
        const MembraneStress<Real> stress = stress_sum(sites.stress[i], now.stress);
        sites.stress[i] = stress;
        if (sites.projects) sites.tension[i] = tensile_part(stress);
        energy[i] += static_cast<double>(of.area(i) * (now.stored + now.lost));
        tangent[i] = now.tangent;
      });
}

template <class Strains, class Device>
void InPlaneFriction<Strains, Device>::add_stored(const Strains& strains, const Vec3<Real>* x,
                                                  double* energy) {
  const StrainStops<Real> stops = view();
  const Strains of = strains;
  for_each(
      device_, "membrane friction energy", sites_, HYST_KERNEL(int i) {
        energy[i] += static_cast<double>(of.area(i) * stops.reply(i, of.at(i, x)).stored);
      });
}

template <class Strains, class Device>
void InPlaneFriction<Strains, Device>::commit(const Strains& strains, const Vec3<Real>* x, bool is_start) {
  const StrainStops<Real> stops = view();
  const Strains of = strains;
  double* lost = lost_.data();
  for_each(
      device_, {"membrane history", total_bytes(slip_, lost_)}, sites_, HYST_KERNEL(int i) {
        const Vec3<Real> strain = of.at(i, x);
        if (!is_start) lost[i] += static_cast<double>(of.area(i) * stops.reply(i, strain).lost);
        stops.accept(i, strain);
      });
}

template <class Strains, class Device>
double InPlaneFriction<Strains, Device>::loss() const {
  const std::vector<double> values = lost_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Strains, class Device>
void InPlaneFriction<Strains, Device>::serialise(Archive& archive) {
  if (!any()) return;
  hysteron::serialise(archive, device_, slip_, lost_);
}

template class InPlaneFriction<FaceStrains<double>, ThisDevice>;
template class InPlaneFriction<FaceStrains<float>, ThisDevice>;
template class InPlaneFriction<NodeStrains<double>, ThisDevice>;
template class InPlaneFriction<NodeStrains<float>, ThisDevice>;

}  // namespace hysteron
