// Friction in the plane of a whole cloth on one device.  A fabric without stops has no memory here, and its
// cloth no loop.
#pragma once

#include "sim/device/archive_buffer.h"
#include "sim/membrane/strain_stops.h"
#include "sim/membrane/strains.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Stresses of triangles or nodes, and what friction is added to.
template <class Real>
struct SiteStresses {
  MembraneStress<Real>*stress, *tension;
  bool projects;  // nothing is added after friction: `tension` becomes its tensile part
};

// Of triangles or of nodes (strains.h): the sites.
template <class Strains, class Device>
class InPlaneFriction {
 public:
  using Real = typename Strains::Real;

  InPlaneFriction(Device& device, const InPlaneStops& stops, int sites);

  bool any() const { return slip_.size() > 0; }
  // Adds friction to stresses that are elastic and viscous, and to tension, which is elastic.
  void add(const Strains& strains, const SiteStresses<Real>& to);
  // The same in a step that is tried, with its potential [J]; tension becomes that of the whole stress.
  void add_to_trial(const Strains& strains, const SiteStresses<Real>& to, double* energy);
  const Vec3<Real>* tangents() const {
    return tangent_.data();
  }  // where either was called last, by site [N/m]

  void add_stored(const Strains& strains, const Vec3<Real>* position, double* energy);
  // Accepts positions.  What the stops lose on the way counts unless `is_start`: cloth starts with stops that
  // its start shape has dragged along.
  void commit(const Strains& strains, const Vec3<Real>* position, bool is_start);
  double loss() const;  // since the start [J]

  void visit(Archive& archive);
  std::size_t history_bytes() const { return bytes_of(slip_, lost_); }
  std::size_t bytes() const { return bytes_of(stop_, tangent_); }  // beside its history

 private:
  StrainStops<Real> view() { return {stop_.data(), {0, end_[0], end_[1], end_[2]}, slip_.data(), sites_}; }

  Device& device_;
  int sites_;
  int end_[3];  // of the stops of each component
  Buffer<StrainStop<Real>, Device> stop_;
  Buffer<Real, Device> slip_;           // StrainStops::slip
  Buffer<Vec3<Real>, Device> tangent_;  // by component
  Buffer<double, Device> lost_;         // by site [J]
};

}  // namespace hysteron
