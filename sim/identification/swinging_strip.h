// Computes a hanging strip that swings in its first mode with friction in bending: the energies that it
// stores and loses at an amplitude.
//
// The mode is that of a beam of length L under its own weight, with the rigidity of each place that of a
// cycle of its curvature k = A |phi''| (harmonic balance; Caughey 1960),
//
//   (B(k) phi'')'' - (T phi')' = sigma omega^2 phi,   T = sigma g (L - s),   phi(L) = 1
//   B(k) = B0 + sum_j p_j f(r_j/k),   f(u) = (theta - sin theta cos theta)/pi,   cos theta = 1 - 2 u;
//   f = 1 of stops that do not slip.
//
// Friction that has slipped leaves a strip as limp as B0 near its clamp, where curvature then gathers, and
// the same strip swings as stiffly as B0 + sum p_j when it moves little: modes follow the amplitude.
//
//   stored at a turn  E = int B0 k^2/2 + sum_j p_j min(k, r_j)^2/2 ds + A^2/2 int T phi'^2 ds
//   lost in a cycle   D = int sum_j 4 p_j r_j (k - r_j)+ ds
//
// It is exact for small deflections and a loss in a cycle that is small beside the energy stored.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/bending/laws/bending_parts.h"

namespace hysteron {

struct SwingState {
  double amplitude = 0;  // A, of the free end [m]
  double stored = 0;     // E, per width [N]
  double lost = 0;       // D, per width [N]
  double omega = 0;      // [rad/s]
  double square = 0;     // int phi^2 ds [m]
  double bend = 0;       // int |phi''| ds [1/m]
  double curvature = 0;  // the largest k [1/m]
};

class SwingingStrip {
 public:
  // Takes the length below the clamp [m] and the density [kg/m^2].
  SwingingStrip(double length, double density);

  // Returns the states at the amplitudes [m], which rise; `spring` is B0 > 0 [N m].
  std::vector<SwingState> at(const std::vector<double>& amplitudes, double spring,
                             const Spectrum& stops) const;

 private:
  // Returns the state found from the mode phi, which is replaced by the state's own.
  SwingState state(double amplitude, double spring, const Spectrum& stops, Eigen::VectorXd& phi) const;
  // Returns omega [rad/s], and improves phi from a guess, with the given rigidity at the points [N m].
  double iterate_mode(const Eigen::VectorXd& rigidity, Eigen::VectorXd& phi) const;

  double density_;  // [kg/m^2]
  // Int phi^2 ds [m] and int T phi'^2 ds [N/m] by the free nodes' values.
  Eigen::MatrixXd mass_, tension_;
  Eigen::MatrixXd second_;  // phi'' at the points by these values
  Eigen::VectorXd weight_;  // length weights of the points [m]
};

}  // namespace hysteron
