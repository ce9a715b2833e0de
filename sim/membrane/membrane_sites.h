// Stresses of all triangles, or of all nodes (strains.h), on one device: elastic, of friction, and viscous;
// with their energies and losses.
//
// In an implicit step viscosity is the potential damping/beta_dt * W(E - E_ref), whose stress is damping * C
// dE/dt with dE/dt = (E - E_ref)/beta_dt, so that a step is a minimum problem and rotations cost nothing.
#pragma once

#include "sim/base/step_formula.h"
#include "sim/membrane/in_plane_friction.h"

namespace hysteron {

template <class Strains, class Device>
class MembraneSites {
 public:
  using Real = typename Strains::Real;

  // What all strains read, and of it one vector for each vertex.
  struct Bytes {
    std::size_t strains, vectors;
  };
  // What `strains` points to must outlive it.  `is_last`: what it computes is final, and tension is
  // projected.
  MembraneSites(Device& device, const Strains& strains, int sites, const MembraneStiffness<double>& stiffness,
                double damping, const InPlaneStops& stops, bool is_last, Bytes bytes);

  int count() const { return sites_; }
  const MembraneStiffness<Real>& stiffness() const { return stiffness_; }
  Real damping() const { return damping_; }  // viscous over elastic stiffness [s]
  const MembraneStress<Real>* stress() const { return stress_.data(); }
  MembraneStress<Real>* stress() { return stress_.data(); }
  // Of elasticity and friction after update(), of the whole stress after evaluate(); its tensile part if
  // `is_last`.
  MembraneStress<Real>* tension() { return tension_.data(); }
  const Vec3<Real>* friction_tangents() const { return friction_.tangents(); }

  void update(const Vec3<Real>* position, const Vec3<Real>* velocity);
  void begin_step(const StepFormula& formula, const Vec3<Real>* now, const Vec3<Real>* before);
  void evaluate(const Vec3<Real>* position, double* energy);  // sets a site's energy [J]
  Real viscous_factor() const;                                // viscous over elastic stiffness of a step
  void add_viscous_loss();                                    // of the step that evaluate() saw last
  void add_viscous_loss(const Vec3<Real>* velocity, Real step);
  void find_stored(const Vec3<Real>* position, double* energy);  // [J]
  double viscous_loss() const;                                   // since the start [J]

  bool has_friction() const { return friction_.any(); }
  void commit_friction(const Vec3<Real>* position, bool is_start);
  double friction_loss() const { return friction_.loss(); }  // since the start [J]

  void serialise(Archive& archive) {
    hysteron::serialise(archive, device_, viscous_);
    friction_.serialise(archive);
  }
  std::size_t stress_bytes() const { return total_bytes(stress_); }
  std::size_t tension_bytes() const { return total_bytes(tension_); }
  std::size_t bytes() const {
    return total_bytes(stress_, tension_, viscous_, reference_) + friction_.bytes();
  }
  std::size_t history_bytes() const { return friction_.history_bytes(); }

 private:
  SiteStresses<Real> stresses() { return {stress_.data(), tension_.data(), is_last_}; }

  Device& device_;
  Strains strains_;
  int sites_;
  MembraneStiffness<Real> stiffness_;
  Real damping_;
  bool is_last_;
  Bytes bytes_;
  Buffer<MembraneStress<Real>, Device> stress_, tension_;
  Buffer<double, Device> viscous_;  // lost, by site [J]
  InPlaneFriction<Strains, Device> friction_;
  StepFormula formula_;                   // of implicit steps
  Buffer<Vec3<Real>, Device> reference_;  // strain from which rates are measured; empty without damping
};

}  // namespace hysteron
