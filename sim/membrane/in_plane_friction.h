// Friction in the plane of a whole cloth on one device.  A fabric without stops has no memory here, and its
// cloth no loop.
#pragma once

#include "sim/device/archive_buffer.h"
#include "sim/membrane/strain_stops.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Triangles as they were evaluated last, and what friction is added to.
template <class Real>
struct StressedFaces {
  const MembraneRest<Real>* rest;
  const Deformation<Real>* deformation;
  MembraneStress<Real>*stress, *tension;
};

template <class Real, class Device>
class InPlaneFriction {
 public:
  InPlaneFriction(Device& device, const InPlaneStops& stops, int faces);

  bool any() const { return slip_.size() > 0; }
  // Adds friction to stresses that are elastic and viscous; tension becomes that of elasticity and friction.
  void add(const MembraneStiffness<Real>& elastic, const StressedFaces<Real>& faces);
  // The same in a step that is tried, with its potential [J]; tension becomes that of the whole stress.
  void add_to_trial(const StressedFaces<Real>& faces, double* energy);
  const Vec3<Real>* tangents() const {
    return tangent_.data();
  }  // where either was called last, by face [N/m]

  void add_stored(const MembraneRest<Real>* rest, const Eigen::Vector3i* corner, const Vec3<Real>* position,
                  double* energy);
  // Accepts positions.  What the stops lose on the way counts unless `is_start`: cloth starts with stops that
  // its start shape has dragged along.
  void commit(const MembraneRest<Real>* rest, const Eigen::Vector3i* corner, const Vec3<Real>* position,
              bool is_start);
  double loss() const;  // since the start [J]

  void visit(Archive& archive);
  std::size_t history_bytes() const { return bytes_of(slip_, lost_); }
  std::size_t bytes() const { return bytes_of(stop_, tangent_); }  // beside its history

 private:
  StrainStops<Real> view() { return {stop_.data(), {0, end_[0], end_[1], end_[2]}, slip_.data(), faces_}; }

  Device& device_;
  int faces_;
  int end_[3];  // of the stops of each component
  Buffer<StrainStop<Real>, Device> stop_;
  Buffer<Real, Device> slip_;           // StrainStops::slip
  Buffer<Vec3<Real>, Device> tangent_;  // by component
  Buffer<double, Device> lost_;         // by face [J]
};

}  // namespace hysteron
