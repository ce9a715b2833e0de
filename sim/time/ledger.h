// The ledger of energies: where the energy of a simulation went.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hysteron {

// All terms are in joules.  The balance is (kinetic + gravitational + membrane + bending + contact) - initial
//   = handle_work + obstacle_work - commands - bending_friction - bending_relaxation - membrane_friction
//     - viscous - air - contact_friction - inertia - unbalanced - bending_gap - implicit_gap - gravity_gap +
//     remainder.
// The five integrator terms come from their own formulas (headers of semi_implicit.cpp and
// implicit_step.cpp), so the remainder is the arithmetic's alone.
struct Ledger {
  // These are present energies; gravity's is relative to the start.
  double kinetic = 0, gravitational = 0, membrane = 0, bending = 0, contact = 0;
  double initial = 0;                                                       // their sum at the start
  double pin_work = 0, obstacle_work = 0;                                   // done on the cloth
  double bending_friction = 0, viscous = 0, air = 0, contact_friction = 0;  // lost to physics
  double bending_relaxation = 0;  // lost to physics by relaxing branches
  double membrane_friction = 0;   // lost to physics by stops in the plane
  double commands = 0;      // recoverable bending energy that ironing and edits took, less what they gave
  double inertia = 0;       // lost by the integrator: sum of m |dv|^2/2 over all velocity changes
  double unbalanced = 0;    // lost to forces that an implicit solve has left unbalanced
  double bending_gap = 0;   // lost by explicit bending: -(change of its energy + losses + work of its forces)
  double implicit_gap = 0;  // lost by the implicit stage: the same for membrane and contact
  double gravity_gap = 0;   // lost by splitting: gravity acts in the substeps, the implicit stage moves on
  double remainder = 0;     // not explained by any term
  double remainder_relative = 0;  // over the sum of the terms' magnitudes

  double integrator() const { return inertia + unbalanced + bending_gap + implicit_gap + gravity_gap; }
  // Returns the energy that the integrator took, or gave, over all that was dissipated; 0 where nothing was.
  double integrator_share() const;
  // Sets the remainder from the other terms.
  void close();
  std::vector<std::pair<std::string, double>> rows() const;  // name, value, in the balance's order
};

// The running sums of one vertex [J]; the sums' differences are the ledger's integrator terms.
struct VertexLedger {
  double bending_work = 0;   // work of bending forces over the displacements
  double gravity_work = 0;   // work of gravity
  double air = 0;            // lost to air drag
  double inertia = 0;        // lost by the integrator: work of all forces less the change of kinetic energy
  double unbalanced = 0;     // taken by forces that the solve has left unbalanced
  double implicit_work = 0;  // work of membrane and contact
  double pin_work = 0;       // done on the cloth by the pin that moves this vertex
};

}  // namespace hysteron
