// Reads the cause of a swing's decay from how its amplitude falls in time: turning points, amplitudes, and
// the one of five shapes that describes them best.
//
//   linear       A = a - b t          friction that is saturated: its moment is constant
//   two-step     two such lines       friction that saturates early, and another one below
//   exponential  A = a exp(-b t)      viscosity
//   hyperbolic   A = a/(1 + b t)      dA/dn = -c A^2: friction whose small loops have areas growing as A^3,
//                                     as those of Rayleigh and of every law that is a parabola up to its
//                                     elastic limit (Masing 1926)
//   saturating                        the chapter's friction, a line above its knee and a hyperbola below
//                                     (saturating_decay.h)
//
// The shape is chosen by Schwarz's criterion n ln(s^2) + k ln n (1978), with s^2 the mean square residual of
// a shape of k numbers, no smaller than that of kBestAccuracy of the largest amplitude.  Two lines and the
// saturating shape have four numbers, the others two.  A shape of four that is not clearly better than one of
// its limits (a line; of the saturating shape also the hyperbola) gives way to it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/base/enum_names.h"

namespace hysteron {

// Returns the extreme of the parabola through three samples: its time from the middle one, and its value; the
// middle one if they lie on a line.  `before` and `after` are the times to the neighbours [s], both positive.
Eigen::Vector2d vertex_of_parabola(double before, double after, const Eigen::Vector3d& x);

// Returns the extreme of the parabola through three equally spaced samples: its place, in samples from the
// middle one, and its value; the middle one if they lie on a line.
Eigen::Vector2d vertex_of_parabola(double before, double at, double after);

struct TurningPoint {
  double time;   // [s]
  double value;  // of the series
};

// Returns the points where a series in `time` turns and goes back by more than `least` and, once it has
// swung, by more than the `fraction` of its last swing, each by the parabola through the samples around it.
// Both vectors have one length; the start is not a turn.
std::vector<TurningPoint> turning_points(const std::vector<double>& time, const std::vector<double>& x,
                                         double least, double fraction = 0);

struct Amplitude {
  int turn;      // index of the turning point
  double time;   // [s]
  double value;  // half of its distance to the mean of its neighbours [m]
};
// Returns the amplitude of every turning point between two others.
std::vector<Amplitude> turning_amplitudes(const std::vector<TurningPoint>& turns);

enum class DecayShape {
  linear,
  two_step,
  exponential,
  hyperbolic,
  saturating,
  plateau,  // a half period loses less than kPlateau: nothing brakes
  // There are too few amplitudes, they fall by less than kMinFall, or two shapes describe them alike.
  unknown,
};
constexpr std::array<const char*, 7> names(DecayShape) {
  return {"linear", "two-step", "exponential", "hyperbolic", "saturating", "plateau", "unknown"};
}

constexpr double kPlateau = 0.01;          // of the amplitude, in a half period
constexpr std::size_t kMinAmplitudes = 6;  // two lines of three each
constexpr double kMinFall = 0.2;           // relative fall up to the last one: of less, shapes are the same
// Margins of the criterion: less is "not worth more than a bare mention", and less than the second
// "positive", not "strong" (Kass & Raftery 1995).
constexpr double kMinMargin = 2, kClearMargin = 6;
// A share of a swing: smaller reversals are a higher mode's ripple on it.
constexpr double kSwingRipple = 0.25;

// One shape, fitted by least squares of the amplitudes. t is the time since the first one [s].
struct DecayFit {
  DecayShape shape = DecayShape::unknown;
  double first = 0;       // a: amplitude at t = 0 [m]
  double rate = 0;        // b: for lines and saturated friction [m/s], for the other shapes [1/s]
  double step = 0;        // for two lines: where the second begins [s] ...
  double last_rate = 0;   // ... and its b [m/s]
  double knee = 0;        // for the saturating shape: the amplitude at its knee [m] ...
  double stiffening = 1;  // ... and how much stiffer the smallest swings are
  double rms = 0;         // root mean square residual [m]
  double criterion = 0;

  double at(double t) const;
};

// Fits a line to at least two amplitudes.
DecayFit line_through(const std::vector<Amplitude>& amplitudes);

struct Decay {
  DecayShape shape = DecayShape::unknown;
  std::size_t first = 0;  // first amplitude used: earlier ones are of several modes or too large
  std::size_t used = 0;
  double per_turn = 0;  // mean relative loss: 1 - (A_last/A_first)^(1/turns)
  // The fits of all shapes, the best first; none for a plateau or too few amplitudes.
  std::vector<DecayFit> fits;
  double margin = 0;  // of the criterion, from the best to the next of another kind

  const DecayFit& best() const { return fits.front(); }
  const DecayFit& of(DecayShape shape) const;  // the fit of that shape
  // Returns where the second line begins, over the first amplitude.
  double step_fraction() const {
    return of(DecayShape::two_step).at(of(DecayShape::two_step).step) / best().first;
  }
  // Returns the amplitude at the knee of the saturating shape over its first one.
  double knee_fraction() const { return of(DecayShape::saturating).knee / of(DecayShape::saturating).first; }
};

// Analyses amplitudes in the order of time, as turning_amplitudes() returns them.  It leaves out those above
// `largest` [m], and all before the last half period that one mode alone would not make: one that grows, or
// that falls by much more than those around it.
Decay decay_between_amplitudes(const std::vector<Amplitude>& amplitudes, double largest);

// Returns the loss in half a period over the amplitude where that is `fraction` of the one numbered `first`:
// between neighbouring pairs, interpolated in the logarithm of their mean amplitude.  NaN if they do not
// reach it.
double half_period_loss(const std::vector<Amplitude>& amplitudes, std::size_t first, double fraction);

}  // namespace hysteron
