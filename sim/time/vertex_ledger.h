// Running sums of one vertex.
#pragma once

namespace hysteron {

// All in joules; the sums' differences are the ledger's integrator terms.
struct VertexLedger {
  double bending_work = 0;   // of bending forces over the displacements
  double gravity_work = 0;   // of gravity
  double air = 0;            // lost to air drag
  double inertia = 0;        // lost by the integrator: work of all forces less the change of kinetic energy
  double unbalanced = 0;     // taken away by forces that the solve has left unbalanced
  double implicit_work = 0;  // of membrane and contact
  double handle_work = 0;    // done on the cloth by the hand that moves this vertex
};

}  // namespace hysteron
