// Free vibrations of a clamped-free strip: how fast bending friction and viscosity damp them, in the
// simulated cloth and in the energy balance of one mode.
#pragma once

#include <vector>

#include "experiments/specimens/cantilever_strip.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// The first mode of a clamped-free beam at a distance `xi` from its clamp, in lengths: deflection over that
// of the free end, and curvature over that of the clamp.
double mode_deflection(double xi);
double mode_curvature(double xi);
// Returns the curvature at the clamp [1/m] when the free end of a strip of this length [m] is deflected by
// one length.
double mode_clamp_curvature(double length);
// Returns 1.8751^2 sqrt(B/(density L^4)) [rad/s] of a beam of rigidity `b` [N m], `density` [kg/m^2] and
// `length` [m].
double mode_frequency(double b, double density, double length);
// Returns the curvatures over the clamp's, at the middles of `parts` equal parts of the strip.
std::vector<double> mode_curvatures(int parts);

// A cloth's response to cyclic bending.  Amplitudes are curvatures [1/m], never negative.
struct DecayingBend {
  VirginCurve curve;
  double viscosity = 0;  // bending moment over curvature rate [N m s]
  double frequency = 0;  // angular frequency for the viscous loss [rad/s]

  double loss(double amplitude) const;          // energy dissipated per cycle [J/m^2]
  double stored_slope(double amplitude) const;  // d(energy stored at the turning point)/d(amplitude) [N]
};

// Returns the amplitudes after 0, 1, ..., `cycles` cycles, where the parts of the strip bend by `shape` times
// the amplitude: dA/dn = -sum of losses / sum of d(stored)/dA, for a decay that is slow and leaves the mode's
// shape as it is.  A shape of a single 1 is a strip that bends uniformly.
std::vector<double> amplitudes_by_energy(const DecayingBend& bend, const std::vector<double>& shape,
                                         double first, int cycles);

// The closed laws of decay that the energy balance approaches for weak damping.
enum class DecayKind {
  hyperbolic,   // friction, amplitude <= K0: 1/A_n = 1/A_0 + (4/3) |c1|/b1 n
  linear,       // friction, amplitude >> K0: A_n = A_0 - 4 M0/b2 n
  exponential,  // viscosity: A_n = A_0 exp(-pi T w n), with T = viscosity/b2
};

// Returns the scene of a strip without weight, air and any damping but that of the kind.  The solver's
// settings are the defaults.
Scene decay_scene(DecayKind kind);
// The strip's length [m], its first amplitude at the clamp [1/m], and its bending response for the energy
// balance.
double decay_length();
double decay_first_amplitude();
DecayingBend decaying_bend(const Scene& scene);
// Returns the period [s] of a linear strip whose rigidity is the virgin curve's secant to the first
// amplitude.
double decay_period(const Scene& scene);

// Returns `flat` at rest in its first mode, with amplitude decay_first_amplitude() and the edge lengths it
// has when flat.
Cloth bent_in_first_mode(const CantileverStrip& flat);

struct MeasuredDecay {
  // The first mode's part of the free end's deflection, at the start and after each cycle [m].  The whole
  // deflection differs from it by up to 0.1 % of the first one because of higher modes, 0.3 % of what 20
  // cycles lose.
  std::vector<double> peaks;
  double period = 0;  // mean over all cycles [s]

  double loss() const {
    return 1 - peaks.back() / peaks.front();
  }  // amplitude lost, over the first amplitude
};

// Runs the simulation of a strip that starts as above until it has come back `cycles` times. Throws
// Error::simulation if that takes much longer than the strip's period.
MeasuredDecay measure_decay(Simulation& simulation, const CantileverStrip& flat, int cycles);

}  // namespace hysteron::experiments
