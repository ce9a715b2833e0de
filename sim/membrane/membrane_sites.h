// Computes stresses of all triangles, or of all nodes (strains.h), on one device: elastic, frictional and
// viscous, with their energies and losses.
//
// In an implicit step viscosity is the potential damping/beta_dt * W(E - E_ref), whose stress is damping * C
// dE/dt with dE/dt = (E - E_ref)/beta_dt, so that a step is a minimum problem and rotations cost nothing.
//
// For a fabric without stops there is neither memory nor a loop for friction.
#pragma once

#include <cmath>

#include "sim/base/step_formula.h"
#include "sim/device/archive_buffer.h"
#include "sim/membrane/in_plane_friction.h"
#include "sim/membrane/strains.h"
#include "sim/scene/scene.h"

namespace hysteron {

template <class Strains, class Device>
class MembraneSites {
 public:
  using Real = typename Strains::Real;

  // Bytes that all strains read, and those of one vector per vertex.
  struct Bytes {
    std::size_t strains, vectors;
  };
  // The arrays of `strains` must outlive it.  `is_last`: its stress is final, and tension is projected.
  MembraneSites(Device& device, const Strains& strains, int sites, const MembraneStiffness<double>& stiffness,
                double damping, const InPlaneStops& stops, bool is_last, Bytes bytes);

  int count() const { return sites_; }
  const Strains& strains() const { return strains_; }
  const MembraneStiffness<Real>& stiffness() const { return stiffness_; }
  Real damping() const { return damping_; }  // viscous over elastic stiffness [s]
  const MembraneStress<Real>* stress() const { return stress_.data(); }
  MembraneStress<Real>* stress() { return stress_.data(); }
  // The tension: that of elasticity and friction after update(), of the whole stress after evaluate(); its
  // tensile part if `is_last`.
  MembraneStress<Real>* tension() { return tension_.data(); }
  // The tangents of stops where update() or evaluate() was called last, by site [N/m]; null without stops.
  const Vec3<Real>* friction_tangents() const { return tangent_.data(); }

  // Arrays of positions and velocities have n vertices [m], [m/s].
  void update(const Vec3<Real>* position, const Vec3<Real>* velocity);
  void begin_step(const StepFormula& formula, const Vec3<Real>* now, const Vec3<Real>* before);
  void evaluate(const Vec3<Real>* position, double* energy);  // sets one energy per site [J]
  Real viscous_factor() const {                               // viscous over elastic stiffness of a step
    return std::isfinite(formula_.beta_dt) ? damping_ / static_cast<Real>(formula_.beta_dt) : Real(0);
  }
  void add_viscous_loss();  // for the last evaluated step
  void add_viscous_loss(const Vec3<Real>* velocity, Real step);
  void find_stored(const Vec3<Real>* position, double* energy);  // one per site [J]
  double viscous_loss() const { return viscous_.sum(); }         // since the start [J]

  bool has_friction() const { return slip_.size() > 0; }
  // Accepts positions.  The stops' loss on the way counts unless `is_start`: cloth starts with stops that its
  // start shape has dragged along.
  void commit_friction(const Vec3<Real>* position, bool is_start);
  double friction_loss() const { return lost_.sum(); }  // since the start [J]

  void serialise(Archive& archive) {
    hysteron::serialise(archive, device_, viscous_);
    if (has_friction()) hysteron::serialise(archive, device_, slip_, lost_);
  }
  std::size_t stress_bytes() const { return total_bytes(stress_); }
  std::size_t tension_bytes() const { return total_bytes(tension_); }
  std::size_t bytes() const { return total_bytes(stress_, tension_, viscous_, reference_, stop_, tangent_); }
  std::size_t history_bytes() const { return total_bytes(slip_, lost_); }

  // These are parts of update(), evaluate() and find_stored(); public because nvcc allows no device lambda in
  // a private member function.  They add friction to stresses, which are elastic and viscous, and to tension,
  // which is elastic; in a trial step, with friction's potential added to `energy`, tension becomes that of
  // the whole stress.
  void add_friction(double* energy);
  void add_stored_friction(const Vec3<Real>* position, double* energy);

 private:
  StrainStops<Real> stops() {
    return {stop_.data(), {0, end_[0], end_[1], end_[2]}, slip_.data(), sites_, growth_};
  }

  Device& device_;
  Strains strains_;
  int sites_;
  MembraneStiffness<Real> stiffness_;
  Real damping_;
  bool is_last_;
  Bytes bytes_;
  Buffer<MembraneStress<Real>, Device> stress_, tension_;
  Buffer<double, Device> viscous_;  // lost, by site [J]
  int end_[3];                      // ends of each component's stops
  Real growth_;                     // StrainStops::growth
  Buffer<StrainStop<Real>, Device> stop_;
  Buffer<Real, Device> slip_;             // StrainStops::slip
  Buffer<Vec3<Real>, Device> tangent_;    // by component
  Buffer<double, Device> lost_;           // by site [J]
  StepFormula formula_;                   // of implicit steps
  Buffer<Vec3<Real>, Device> reference_;  // strain reference of rates; empty without damping
};

}  // namespace hysteron
