// Free vibrations of a clamped-free strip: how fast they decay by bending friction and by viscosity, as a
// cloth and as the energy balance of one mode.
#pragma once

#include <vector>

#include "experiments/specimens/cantilever_strip.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// First mode of a clamped-free beam at a distance `xi` from its clamp, in lengths: deflection over that of
// the free end, and curvature over that of the clamp.
double mode_deflection(double xi);
double mode_curvature(double xi);
// Curvature at the clamp when the free end of a strip of this length is deflected by one length [1/m].
double mode_clamp_curvature(double length);
// 1.8751^2 sqrt(B/(density L^4)), of a beam of rigidity `b` [N m] and `density` [kg/m^2]: [rad/s].
double mode_frequency(double b, double density, double length);
// Curvatures over the clamp's, at the middles of as many equal parts of the strip.
std::vector<double> mode_curvatures(int parts);

// Cloth bent to and fro.  Amplitudes are curvatures [1/m], never negative.
struct DecayingBend {
  VirginCurve curve;
  double viscosity = 0;  // bending moment over curvature rate [N m s]
  double frequency = 0;  // [rad/s], what the viscosity's loss needs

  double loss(double amplitude) const;          // in a cycle [J/m^2]
  double stored_slope(double amplitude) const;  // d(energy stored at the turning point)/d(amplitude) [N]
};

// Amplitude after 0, 1, ..., `cycles` cycles, where the places of the strip bend by `shape` times the
// amplitude: dA/dn = -sum of losses / sum of d(stored)/dA, for decay that is slow and leaves the mode's shape
// as it is.  A shape of a single 1 is a strip that bends uniformly.
std::vector<double> amplitudes_by_energy(const DecayingBend& bend, const std::vector<double>& shape,
                                         double first, int cycles);

// Closed laws of decay to which that comes for weak damping.
enum class DecayKind {
  hyperbolic,   // friction, amplitude <= K0: 1/A_n = 1/A_0 + (4/3) |c1|/b1 n
  linear,       // friction, amplitude >> K0: A_n = A_0 - 4 M0/b2 n
  exponential,  // viscosity: A_n = A_0 exp(-pi T w n), with T = viscosity/b2
};

// A strip's fabric and law, without weight, air and any damping but that of the kind.  The solver's
// settings are left as they are.
Scene decay_scene(DecayKind kind);
// Its length [m], its first amplitude at the clamp [1/m], and its bend as of an energy balance.
double decay_length();
double decay_first_amplitude();
DecayingBend decaying_bend(const Scene& scene);
// Period of a linear strip whose rigidity is the virgin curve's secant to the first amplitude [s].
double decay_period(const Scene& scene);

// `flat` at rest in its first mode, amplitude decay_first_amplitude(), at the lengths it has when flat.
Cloth bent_in_first_mode(const CantileverStrip& flat);

struct MeasuredDecay {
  // The first mode's part of the free end's deflection, at the start and after each cycle [m]: higher modes
  // add up to 0.1 % of the first deflection to the whole or take it away, 0.3 % of what 20 cycles lose.
  std::vector<double> peaks;
  double period = 0;  // mean of all cycles [s]

  double loss() const { return 1 - peaks.back() / peaks.front(); }  // over the first amplitude
};

// Runs the simulation of a strip that starts as above until it has come back `cycles` times.
// Error::simulation if that takes much longer than the strip's period.
MeasuredDecay measure_decay(Simulation& simulation, const CantileverStrip& flat, int cycles);

}  // namespace hysteron::experiments
