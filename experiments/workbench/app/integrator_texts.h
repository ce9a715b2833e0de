// Says what part of the dissipated energy is the integrator's, where that is much.
#pragma once

#include <string>

#include "sim/time/ledger.h"

namespace hysteron::experiments {

inline constexpr char kIntegrator[] = "the integrator";  // begins the warnings about it

// Warns if the integrator took or gave more than a quarter of all dissipated energy; "" otherwise.  The step
// [s] that it names for an integrator that takes is an estimate, assuming that its part falls as the step
// does: none is named if it is less than a hundredth of the current one, nor for cloth that dissipates
// nothing itself.
std::string integrator_text(const Ledger& ledger, double step);

// Says what shorter steps would change, from runs in steps of `step` [s] and of its half, whose parts `part`
// and `at_half` are what the integrator took (or, negative, gave) over what else was dissipated: their line
// leads to a step in which its share is a quarter, or to a share that no step goes below.
std::string integrator_text(double part, double at_half, double step);

}  // namespace hysteron::experiments
