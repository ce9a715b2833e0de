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
HYST_HD MembraneStress<Real> sum_of(const MembraneStress<Real>& a, const Vec3<Real>& b) {
  return {a.s11 + b[0], a.s22 + b[1], a.s12 + b[2]};
}

template <class Real>
HYST_HD Vec3<Real> strain_at(const MembraneRest<Real>& rest, const Eigen::Vector3i& t, const Vec3<Real>* x) {
  return green_strain(deformation(rest, x[t[0]], x[t[1]], x[t[2]]));
}

}  // namespace

template <class Real, class Device>
InPlaneFriction<Real, Device>::InPlaneFriction(Device& device, const InPlaneStops& stops, int faces)
    : device_(device),
      faces_(faces),
      end_{static_cast<int>(stops.warp.size()), static_cast<int>(stops.warp.size() + stops.weft.size()),
           static_cast<int>(stops.warp.size() + stops.weft.size() + stops.shear.size())},
      stop_(device, all_stops<Real>(stops)),
      slip_(device, static_cast<std::size_t>(faces) * end_[2]),
      tangent_(device, any() ? faces : 0),
      lost_(device, any() ? faces : 0) {}

template <class Real, class Device>
void InPlaneFriction<Real, Device>::add(const MembraneStiffness<Real>& elastic,
                                        const StressedFaces<Real>& faces) {
  const StrainStops<Real> stops = view();
  const MembraneStiffness<Real> c = elastic;
  const StressedFaces<Real> of = faces;
  Vec3<Real>* tangent = tangent_.data();
  for_each(
      device_, {"membrane friction", bytes_of(slip_, tangent_)}, faces_, HYST_KERNEL(int f) {
        const Vec3<Real> strain = green_strain(of.deformation[f]);
        const StopsReply<Real> now = stops.reply(f, strain);
        of.stress[f] = sum_of(of.stress[f], now.stress);
        of.tension[f] = tensile_part(sum_of(membrane_stress(c, strain), now.stress));
        tangent[f] = now.tangent;
      });
}

template <class Real, class Device>
void InPlaneFriction<Real, Device>::add_to_trial(const StressedFaces<Real>& faces, double* energy) {
  const StrainStops<Real> stops = view();
  const StressedFaces<Real> of = faces;
  Vec3<Real>* tangent = tangent_.data();
  for_each(
      device_, {"membrane friction, tried", bytes_of(slip_, tangent_)}, faces_, HYST_KERNEL(int f) {
        const StopsReply<Real> now = stops.reply(f, green_strain(of.deformation[f]));
        of.stress[f] = sum_of(of.stress[f], now.stress);
        of.tension[f] = tensile_part(of.stress[f]);
        energy[f] += static_cast<double>(of.rest[f].area * (now.stored + now.lost));
        tangent[f] = now.tangent;
      });
}

template <class Real, class Device>
void InPlaneFriction<Real, Device>::add_stored(const MembraneRest<Real>* rest, const Eigen::Vector3i* corner,
                                               const Vec3<Real>* x, double* energy) {
  const StrainStops<Real> stops = view();
  for_each(
      device_, "membrane friction energy", faces_, HYST_KERNEL(int f) {
        const Real stored = stops.reply(f, strain_at(rest[f], corner[f], x)).stored;
        energy[f] += static_cast<double>(rest[f].area * stored);
      });
}

template <class Real, class Device>
void InPlaneFriction<Real, Device>::commit(const MembraneRest<Real>* rest, const Eigen::Vector3i* corner,
                                           const Vec3<Real>* x, bool is_start) {
  const StrainStops<Real> stops = view();
  double* lost = lost_.data();
  for_each(
      device_, {"membrane history", bytes_of(slip_, lost_)}, faces_, HYST_KERNEL(int f) {
        const Vec3<Real> strain = strain_at(rest[f], corner[f], x);
        if (!is_start) lost[f] += static_cast<double>(rest[f].area * stops.reply(f, strain).lost);
        stops.accept(f, strain);
      });
}

template <class Real, class Device>
double InPlaneFriction<Real, Device>::loss() const {
  const std::vector<double> values = lost_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
void InPlaneFriction<Real, Device>::visit(Archive& archive) {
  if (!any()) return;
  hysteron::visit(archive, device_, slip_);
  hysteron::visit(archive, device_, lost_);
}

template class InPlaneFriction<double, ThisDevice>;
template class InPlaneFriction<float, ThisDevice>;

}  // namespace hysteron
