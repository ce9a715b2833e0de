// Forms that friction may have when it is sought in measured loops: from few parameters to stops.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "sim/bending/laws/friction_shape.h"

namespace hysteron {

// Parameters are of order one and 0 where nothing is known but the friction moment by the loops' work [N], on
// which they are centred with the standard deviations `spreads` (ridge of Hoerl & Kennard 1970).
struct FrictionForm {
  std::string name;
  std::vector<double> spreads;
  std::function<Spectrum(const Eigen::VectorXd& parameters, double friction_moment)> stops;
};

// Stops at thresholds that are given [1/m]: logarithms of their moments, shared alike.
FrictionForm free_stops(const std::vector<double>& thresholds);

// Of two numbers (friction_shape.h): logarithms of HB, of median and spread over kUsualMedian and
// kUsualSpread.
inline constexpr double kUsualMedian = 10, kUsualSpread = 1.5;  // 1/m, 1: between measured spectra
FrictionForm shaped_friction();
FrictionShape shape_of(const Eigen::VectorXd& parameters);

// Friction that saturates at k0 [1/m] as even stops: the logarithm of HB.
FrictionForm even_friction(double k0);

// Standard errors of the logarithms of the stops' stiffnesses and, last, of their friction moment, from the
// covariance of the parameters.
Eigen::VectorXd stop_errors(const FrictionForm& form, const Eigen::VectorXd& parameters,
                            const Eigen::MatrixXd& covariance);

}  // namespace hysteron
