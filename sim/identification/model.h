// Models a measured series of moments by a fabric's three numbers, and minimises the squares of the
// residuals.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "sim/identification/least_squares.h"
#include "sim/identification/series.h"
#include "sim/identification/turns.h"

namespace hysteron {

// The unknowns beside the three numbers.
struct SoughtBeside {
  bool moment = false, curvature = false;  // the instrument's zeros
  double step_at_turns = INFINITY;         // seeks turns between rows beside a larger step [1/m]
};

// b2, g = b1 - b2, k0, and the instrument's zeros if they are sought.
struct CurvePoint {
  double b2 = 0, g = 0;  // [N m], >= 0
  double k0 = 0;         // [1/m]
  // The sought zeros of moment and of curvature, over the largest of the data; then, if turns are sought, how
  // far beyond its row each is, over the step beside it.
  Eigen::VectorXd nuisance;
  double sum = 0;  // of squared residuals

  VirginCurve curve() const { return {b2 + g, b2, k0}; }
};

// Numbers that a law does not read: the data cannot fix them, however well it describes them.
struct UnreadNumbers {
  bool b1 = false, k0 = false;
};

// A law's moments along a measured series.
class MomentModel {
 public:
  // The curve of `law` is ignored; `cycling` is as in law_rows().  Throws Error::invalid_input as run_law()
  // does.
  MomentModel(const MomentSeries& series, const LawRequest& law, SoughtBeside beside, bool cycling);

  // Returns the moments of the law at the series' rows [N], at curvatures less the zero of curvature, with
  // the zero of moment added; NaN where the law does not accept the numbers.
  Eigen::VectorXd moments(const CurvePoint& point) const;
  // Returns model minus measurement over the largest moment.
  Eigen::VectorXd residuals(const CurvePoint& point) const;
  // Returns the best b2, g and nuisance parameters at one k0.  They are solved directly for laws whose moment
  // is linear in b2 and g: all whose friction is a fixed shape, unless the zero of curvature is sought.
  // Turns stay at their rows.
  CurvePoint best_at(double k0, int& iterations) const;

  // Returns the numbers that change no moment of the law here: it does not read them.
  UnreadNumbers unread(const CurvePoint& point) const;

  // Returns the parameters of the whole fit: logarithms of b2, g, k0 over their scales, then the nuisance
  // parameters.
  Eigen::VectorXd parameters(const CurvePoint& point) const;
  CurvePoint point(const Eigen::VectorXd& parameters) const;
  // Returns their bounds, low and high.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> bounds() const;
  // Returns those of the nuisance parameters.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> nuisance_bounds() const;

  // Returns the best points at each of many k0, in rising order.  Turns stay at their rows.
  std::vector<CurvePoint> scan(int& iterations) const;
  std::vector<double> scanned_k0() const;  // [1/m]
  // Returns the best point at the k0 of `begin` by iterations from there.
  CurvePoint searched_from(const CurvePoint& begin, int& iterations, SearchLimits limits = {}) const;

  // Returns the point from which turns are sought, after the best with turns at their rows: at the rows, and
  // where even steps put them, with some k0.
  CurvePoint start_with_turns(const CurvePoint& at_rows) const;

  double largest_curvature() const { return curvature_; }
  double largest_step_at_turns() const { return largest_step(turns_); }  // among those sought [1/m]
  // Returns where the law turns at the sought turns [1/m], in the order of the rows.
  std::vector<double> turning_curvatures(const CurvePoint& point) const;

 private:
  struct LinearSolution {
    CurvePoint point;
    bool holds;  // true if the law is linear in b2 and g
  };
  // Returns the moments without the zero of moment [N].
  Eigen::VectorXd law_moments(const CurvePoint& point) const;
  int zeros() const { return (beside_.moment ? 1 : 0) + (beside_.curvature ? 1 : 0); }
  int nuisances() const { return zeros() + static_cast<int>(turns_.size()); }
  Eigen::VectorXd turns_at(const CurvePoint& point) const {
    return point.nuisance.tail(static_cast<int>(turns_.size()));
  }
  double curvature_zero(const CurvePoint& point) const;  // [1/m]
  // Returns the best b2, g and zero of moment, if they enter linearly, beside the other nuisance parameters.
  LinearSolution linear_at(double k0, const Eigen::VectorXd& nuisance) const;
  // Returns the starts of the search for nuisance parameters: each possible zero of curvature.
  std::vector<Eigen::VectorXd> nuisance_starts() const;

  LawRequest law_;
  std::vector<LawRow> rows_;
  Eigen::VectorXd moment_;  // measured [N]
  SoughtBeside beside_;
  std::vector<SoughtTurn> turns_;  // none unless turns are sought
  double largest_;                 // moment [N]
  double curvature_, slope_;       // scales: largest curvature [1/m], moment over curvature [N m]
};

// A fit in which the three numbers follow from fewer factors, with free nuisance parameters.
struct Tied {
  CurvePoint best;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  // by the logarithms of the factors, then the nuisance parameters
  int iterations = 0;
};
// Returns the numbers (not the nuisance parameters) at factors on a starting point, where all are 1.
using FromFactors = std::function<CurvePoint(const Eigen::VectorXd&)>;

Tied fit_tied(const MomentModel& model, const FromFactors& numbers, int factors, const CurvePoint& start,
              SearchLimits limits = {});

}  // namespace hysteron
