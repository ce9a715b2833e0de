// Identifies friction elements of bending from the loops of a FAB tester: the test is simulated with trial
// elements, and the forces are compared.
//
// Friction is sought in one of the forms below: stops on a fixed grid, so that a coarse record decides about
// stiffnesses alone, or a shape of two numbers.  The unknowns have a prior, without which elements that a
// cycle hardly slips would go to nothing or grow without bound (Tarantola 2005, section 3.2): a friction
// moment by the work of the loop over the change of the bend; b2 by HB/b2 of textiles.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/bending/laws/friction_shape.h"
#include "sim/identification/fab_cycles.h"
#include "sim/scene/key_table.h"

namespace hysteron {

// These are the forms that friction may have when it is sought in measured loops: from few parameters to
// stops.

// A form's parameters are of order one and 0 at the prior: the friction moment by the loops' work [N], around
// which they have the standard deviations `spreads` (ridge of Hoerl & Kennard 1970).
struct FrictionForm {
  std::string name;
  std::vector<double> spreads;
  std::function<Spectrum(const Eigen::VectorXd& parameters, double friction_moment)> stops;
  // The search begins from 0 and from each of these: the sum of squares may have several minima.
  std::vector<Eigen::VectorXd> starts = {};
  // Returns the largest parameters with which the form describes data up to this curvature `reach` [1/m];
  // none: unbounded.
  std::function<Eigen::VectorXd(double reach)> largest = {};
};

// This number of stops misses the virgin curve of the parabola by less than 1 % of its friction moment.
inline constexpr int kFewStops = 12;

inline constexpr const char *kShapedName = "shaped", *kParabolaName = "chapter's";

// Stops at given thresholds [1/m]; the parameters are logarithms of their moments, all with one prior.
FrictionForm free_stops(const std::vector<double>& thresholds);

// The shape of two numbers (friction_shape.h); the parameters are logarithms of HB, and of median and spread
// over kUsualMedian and kUsualSpread.  Half of the friction slips within the data's reach: no data can tell
// more.
inline constexpr double kUsualMedian = 10, kUsualSpread = 1.5;  // [1/m], [-]: between measured spectra
FrictionForm shaped_friction();
FrictionShape friction_shape(const Eigen::VectorXd& parameters);

// The chapter's parabola of two numbers; the parameters are logarithms of HB and of k0 over kUsualSaturation.
inline constexpr double kUsualSaturation = 10;  // [1/m]
FrictionForm parabola_friction();
double saturation_curvature(const Eigen::VectorXd& parameters);  // k0 [1/m]

// Friction that saturates at k0 [1/m] along the chapter's parabola; the parameter is the logarithm of HB.
FrictionForm even_friction(double k0, int stops = kMaxStops);

// Returns the standard errors of the logarithms of the stops' stiffnesses and, last, of their friction
// moment, from the covariance of the parameters.
Eigen::VectorXd stop_errors(const FrictionForm& form, const Eigen::VectorXd& parameters,
                            const Eigen::MatrixXd& covariance);

struct FabBendingQuestion {
  std::vector<int> cycles = {2};                                        // fitted cycles, the first being 1
  std::vector<double> thresholds = {1, 2, 4, 8, 16, 32, 64, 128, 256};  // of free stops, rising [1/m]
  std::optional<FrictionForm> form = {};                                // in place of free stops
  double density = 0;                                                   // [kg/m^2]
  // Noise of the force of the whole strip [N]: FAB records scatter by 0.05 to 0.1 gf.
  double noise = 7.5e-4;
  double settling = 5e-4;  // way after a reversal on which records are unreliable [m] ...
  double trust = 0.3;      // ... and their weight there
};

struct FabBending : FabStops {
  double friction_error = kNone;      // standard error of law.friction() [N]
  double first = kNone;               // for a decay: its first amplitude [m]
  std::string form_name;              // name of the FrictionForm
  Eigen::VectorXd form, form_errors;  // parameters of the friction's form and their standard errors
  std::vector<double> zero_errors;    // standard errors [N/m]
  double noise = kNone;               // of the fitted data: the strip's force [N], or amplitudes [m]
  Eigen::VectorXd residuals;          // of the rows, over the noise, with weights of unreliable rows
  double residual_rms = 0;            // their root mean square
  double residual_share = 0;          // rms residual over the range of the fitted data
  double reach = kInfinity;           // largest change of curvature in the fitted data [1/m]

  bool is_shaped() const { return form_name == kShapedName; }
  bool is_parabola() const { return form_name == kParabolaName; }
  double friction_within_reach() const;  // of the stops that have slipped [N]
  bool knows_friction() const;           // most of HB has slipped, and its error is small
  // Names "b2", "stop 128/m", ...; for a shape "median", "spread", "HB"; for the parabola "k0", "HB".
  std::vector<std::string> undetermined() const;
};

// Identifies from loops of one direction that bend.  Throws Error::invalid_input if a cycle is missing.
FabBending identify_fab_bending(const std::vector<FabLoops>& loops, const FabBendingQuestion& question);

// A fit of the same loops with another form of friction.
struct FabForm {
  std::string name;
  FabBending found;
  bool fixes_k0 = false;  // friction saturates at a k0 of a grid: a special case of the chapter's form
};
// Fits friction that saturates at k0 of a grid [1/m]; leaves out k0 for which no equilibrium is found.
std::vector<FabForm> even_forms(const std::vector<FabLoops>& loops, const FabBendingQuestion& question);
std::vector<FabForm> even_form_fits(const std::function<FabBending(const FrictionForm&)>& identify,
                                    int stops = kMaxStops);

// Is this row before the turn, while its branch still goes the other way, or on the way [m] after it on which
// records are unreliable?
bool is_settling(const FabLoops& loops, int branch, std::size_t row, double settling);

// Identifies the one element of the grid that describes the loops best: a constant 2HB.
FabBending identify_one_stop(const std::vector<FabLoops>& loops, const FabBendingQuestion& question);

}  // namespace hysteron
