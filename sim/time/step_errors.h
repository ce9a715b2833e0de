// When a run cannot go on: Error::simulation that says where, when, and what presses there.
#pragma once

#include <vector>

#include "sim/time/body.h"
#include "sim/time/implicit_step.h"

namespace hysteron {

// An obstacle that has come since `met` is where the cloth is.  What hands hold may be inside it: contact is
// told.
template <class Real, class Device>
void throw_if_arrival(Body<Real, Device>& body, double met, double time);
// Pins release cloth inside an obstacle.
template <class Real, class Device>
void throw_if_release(Body<Real, Device>& body, const std::vector<char>& held, double time);
// A step has no solution, even in parts of h.
template <class Real, class Device>
void throw_if_unbalanced(Body<Real, Device>& body, ImplicitStep<Real, Device>& step, double start, double h,
                         const NewtonOutcome& outcome);

}  // namespace hysteron
