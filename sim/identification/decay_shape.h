// What takes the amplitude of a swing, read from how it falls: turning points, amplitudes, the exponent p of
// dA/dn = -c A^p.
//
//   p = 0  A_n falls along a line: friction of constant moment
//   p = 1  exponentially: viscosity
//   p = 2  hyperbolically, 1/A_n along a line: friction whose small loops have areas growing as A^3, as those
//          of Rayleigh and of every law that is a parabola up to its elastic limit (Masing 1926; here
//          decay.h)
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

// Extreme of the parabola through three equally spaced samples: where, in samples from the middle one, and
// its value.  The middle one where they lie on a line.
Eigen::Vector2d vertex_of_parabola(double before, double at, double after);

struct TurningPoint {
  double time;   // [s]
  double value;  // of the series
};

// Where a series of equally spaced `time`s turns and goes back by more than `least` and, once it has swung,
// by more than the `share` of its last swing; by the parabola through the samples around.  Both of one
// length; the start is none.
std::vector<TurningPoint> turning_points(const std::vector<double>& time, const std::vector<double>& x,
                                         double least, double share = 0);

struct Amplitude {
  int turn;      // of the turning point, from 0
  double time;   // [s]
  double value;  // half of its distance to the mean of its neighbours
};
// Of every turning point between two others.
std::vector<Amplitude> amplitudes_of(const std::vector<TurningPoint>& turns);

enum class DecayShape {
  linear,       // p below 0.5
  exponential,  // from 0.5
  hyperbolic,   // from 1.5
  steeper,      // from 2.5
  plateau,      // a turn takes less than kPlateau: nothing brakes, and p has no meaning
  unknown,  // p is not known to 0.5, or too few amplitudes are small, or they fall by less than kLeastFall
};
std::string name_of(DecayShape shape);

constexpr double kPlateau = 0.01;            // of the amplitude, in a turn
constexpr std::size_t kLeastAmplitudes = 5;  // three numbers are fitted
// Of the first one by the last: within less, p would be that of what disturbs them.
constexpr double kLeastFall = 0.2;
// Between turns of one mode the amplitude falls by less and never grows by more: what comes before the last
// turn that breaks this is several modes at once.
constexpr double kFallsLess = 0.25, kGrowsLess = 0.05;
// Of a swing: what goes back by less is a higher mode's ripple on it.
constexpr double kSwingRipple = 0.25;

struct Decay {
  DecayShape shape = DecayShape::unknown;
  std::size_t first = 0;  // of the amplitudes: those before are of several modes or too large
  std::size_t used = 0;
  double per_turn = 0;  // mean loss over the amplitude: 1 - (A_last/A_first)^(1/turns)
  // Fitted by least squares of the amplitudes where the shape is one with an exponent.
  std::optional<double> exponent, exponent_stderr;
  double fitted_first = 0;  // amplitude of `first`
  double fitted_loss = 0;   // c A^(p-1) there: loss over the amplitude, in a turn

  // Amplitude `turns` after the first by the fit; needs an exponent.
  double fitted(double turns) const;
};

// A_n with dA/dn = -c A^p, A_0 = `first` and c A_0^(p-1) = `loss`; 0 once it has come to rest.
double decayed(double first, double loss, double exponent, double turns);

// Amplitudes turn by turn, as amplitudes_of() gives them.  Exponents are of
// those that are not above `largest`, since the closed laws are of small swings.
Decay decay_of(const std::vector<Amplitude>& amplitudes, double largest);

}  // namespace hysteron
