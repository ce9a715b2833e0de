// Throws Error::simulation when a run cannot go on, with where, when, and what presses there.
#pragma once

#include <vector>

#include "sim/time/body.h"
#include "sim/time/implicit_step.h"

namespace hysteron {

// Throws if an obstacle that has come since `met` [s] is where the cloth is.  Pinned vertices may be inside
// it, which contact is told.
template <class Real, class Device>
void throw_if_arrival(Body<Real, Device>& body, double met, double time);
// Throws if pins release cloth inside an obstacle.
template <class Real, class Device>
void throw_if_release(Body<Real, Device>& body, const std::vector<char>& held, double time);
// Throws that a step has no solution, even in parts of h [s].
template <class Real, class Device>
void throw_no_equilibrium(Body<Real, Device>& body, ImplicitStep<Real, Device>& step, double start, double h,
                          const NewtonOutcome& outcome);

}  // namespace hysteron
