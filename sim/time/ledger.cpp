#include "sim/time/ledger.h"

#include <cmath>

namespace hysteron {

void Ledger::close() {
  const double now = kinetic + gravitational + membrane + bending + contact;
  const double losses = commands + bending_friction + bending_relaxation + membrane_friction + viscous + air +
                        contact_friction + integrator();
  remainder = now - initial - pin_work - obstacle_work + losses;
  double scale = 0;
  for (double term :
       {kinetic, gravitational, membrane, bending, contact, pin_work, obstacle_work, commands,
        bending_friction, bending_relaxation, membrane_friction, viscous, air, contact_friction, inertia})
    scale += std::abs(term);
  remainder_relative = scale > 0 ? std::abs(remainder) / scale : 0;
}

double Ledger::integrator_share() const {
  const double numerical = std::abs(integrator());
  const double physical = std::abs(bending_friction) + bending_relaxation + membrane_friction + viscous +
                          air + std::abs(contact_friction);
  constexpr double kRounding = 1e-13;  // of the energies, whose differences are the losses
  const double energies = std::abs(kinetic) + std::abs(gravitational) + std::abs(membrane) +
                          std::abs(bending) + std::abs(contact) + std::abs(initial);
  return numerical > kRounding * energies ? numerical / (numerical + physical) : 0;
}

std::vector<std::pair<std::string, double>> Ledger::rows() const {
  return {{"kinetic", kinetic},
          {"gravitational", gravitational},
          {"membrane", membrane},
          {"bending", bending},
          {"contact", contact},
          {"initial", initial},
          {"handle_work", pin_work},
          {"obstacle_work", obstacle_work},
          {"commands", commands},
          {"bending_friction", bending_friction},
          {"bending_relaxation", bending_relaxation},
          {"membrane_friction", membrane_friction},
          {"viscous", viscous},
          {"air", air},
          {"contact_friction", contact_friction},
          {"integrator_inertia", inertia},
          {"integrator_unbalanced", unbalanced},
          {"integrator_bending", bending_gap},
          {"integrator_implicit", implicit_gap},
          {"integrator_gravity", gravity_gap},
          {"remainder", remainder}};
}

}  // namespace hysteron
