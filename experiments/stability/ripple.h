// Measures how fast a ripple at the mesh's highest frequency decays with hysteresis and without.  The chapter
// (4.1, 4.3.2) says that the loop "alleviates high frequency oscillations, a common issue when small time
// steps are used": longer implicit steps damp them numerically, shorter ones do not.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace hysteron::experiments {

// A free square of hinges without gravity, air and viscosity, bent into its highest mode and let go.
struct RippleCase {
  Integrator integrator = Integrator::semi_implicit;
  std::string law = "linear";    // `linear` is the fabric without its friction: the same b2
  double amplitude = 1;          // largest curvature of a hinge at the start over k0
  double steps_per_period = 20;  // for small ripples: of rigidity b1, for `linear` b2
};

struct Ripple {
  RippleCase of;
  double step = 0;  // [s]
  // Times [s] and amplitudes of the mode at reversals, over the first.
  std::vector<double> times{}, amplitudes{};
  double decay = 0;          // share of the amplitude lost per period, mean of kRipplePeriods
  double control = 0;        // the same at half the step
  double closed_form = NAN;  // the same by the energy balance of one mode; 0 for `linear`
  std::string failed{};      // why there is no number; empty if there is one

  double change() const { return control - decay; }  // change by half the step
};
inline constexpr int kRipplePeriods = 10;

// Simulates the case with its step and with half of it.  Refusals by the program are recorded; Error::system
// is thrown.
Ripple measure_ripple(const RippleCase& of);

// The answer to whether hysteresis damps at the shortest step.  For each integrator, amplitude and law with
// friction it compares by how much the decay exceeds that of `linear` with the change of that by half the
// step; the least margin decides.
struct RippleVerdict {
  double excess = 0;   // lost shares of the amplitude per period
  double control = 0;  // change of the excess by half the step
  double margin() const { return excess - control; }
  bool damps() const { return margin() > 0; }
};
RippleVerdict ripple_verdict(const std::vector<Ripple>& ripples);

// Returns `linear` and the laws under each integrator, at two steps and two amplitudes; one amplitude for
// `quick`.
std::vector<RippleCase> ripple_cases(const std::vector<std::string>& integrators,
                                     const std::vector<std::string>& laws, bool quick);

}  // namespace hysteron::experiments
