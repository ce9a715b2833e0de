// A ripple at the mesh's highest frequency: how fast it decays with hysteresis and without.  The chapter
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
  double steps_per_period = 20;  // of small ripples: rigidity b1, `linear` b2
};

struct Ripple {
  RippleCase of;
  double step = 0;                            // [s]
  std::vector<double> times{}, amplitudes{};  // [s]; of the mode, at turning points, over the first
  double decay = 0;          // mean of kRipplePeriods periods, part of the amplitude that each takes
  double control = 0;        // the same with half the step
  double closed_form = NAN;  // the same by the energy balance of one mode; `linear`: 0
  std::string failed{};      // why there is no number; else empty

  double change() const { return control - decay; }  // by half the step
};
inline constexpr int kRipplePeriods = 10;

// Runs it, with its step and with half of it.  What the program refuses is a finding; Error::system is
// thrown.
Ripple measure_ripple(const RippleCase& of);

// Whether hysteresis damps at the shortest step: of each integrator, amplitude and law with friction, by how
// much its decay exceeds that of `linear`, beside what half the step changes in that.  Of all the one that
// shows least.
struct RippleVerdict {
  double excess = 0;   // parts of an amplitude per period
  double control = 0;  // change of the excess by half the step
  double margin() const { return excess - control; }
  bool damps() const { return margin() > 0; }
};
RippleVerdict ripple_verdict(const std::vector<Ripple>& ripples);

// `linear` and the laws under each integrator, at two steps and two amplitudes; one amplitude for `quick`.
std::vector<RippleCase> ripple_cases(const std::vector<std::string>& integrators,
                                     const std::vector<std::string>& laws, bool quick);

}  // namespace hysteron::experiments
