// A measured series of moments as a function of a fabric's three numbers, and its least squares.
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

// What is sought beside the three numbers.
struct SoughtBeside {
  bool moment = false, curvature = false;  // the instrument's zeros
  double step_at_turns = INFINITY;         // turns between rows beside which there is a larger step [1/m]
};

// b2, g = b1 - b2, k0, and the instrument's zeros where they are sought, too.
struct CurvePoint {
  double b2 = 0, g = 0;  // [N m], >= 0
  double k0 = 0;         // [1/m]
  // Zeros that are sought, of moment, of curvature, over the largest of the data; then, where turns are
  // sought, how far beyond its row each is, over the step beside it.
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
  // `law`: its curve is ignored.  `cycling`: as law_rows().  Throws Error::invalid_input as run_law() does.
  MomentModel(const MomentSeries& series, const LawRequest& law, SoughtBeside beside, bool cycling);

  // Moments of the law at the series' rows [N] less the zero of curvature, the zero of moment added; not a
  // number where the law does not take the numbers.
  Eigen::VectorXd moments(const CurvePoint& point) const;
  // Model minus measurement over the largest moment.
  Eigen::VectorXd residuals(const CurvePoint& point) const;
  // Best b2, g and nuisance at one k0.  Solved at once for laws whose moment is linear in b2 and g: all whose
  // friction is a fixed shape, unless the zero of curvature is sought.  Turns stay at their rows.
  CurvePoint best_at(double k0, int& iterations) const;

  // Which numbers change no moment of the law here: it does not read them.
  UnreadNumbers unread(const CurvePoint& point) const;

  // Parameters of the whole fit: logarithms of b2, g, k0 over their scales, then the nuisance.
  Eigen::VectorXd parameters(const CurvePoint& point) const;
  CurvePoint point(const Eigen::VectorXd& parameters) const;
  // Their bounds, low and high.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> bounds() const;
  // Those of the nuisance.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> nuisance_bounds() const;

  // Best at each of many k0, in rising order.  Turns stay at their rows.
  std::vector<CurvePoint> scan(int& iterations) const;
  std::vector<double> scanned_k0() const;  // [1/m]
  // Best at the k0 of a point by iterations, from that point.
  CurvePoint searched_from(const CurvePoint& begin, int& iterations, SearchLimits limits = {}) const;

  // From which turns are sought, after the best with turns at their rows: at the rows, and where even steps
  // put them, with some k0.
  CurvePoint start_with_turns(const CurvePoint& at_rows) const;

  double largest_curvature() const { return curvature_; }
  double largest_step_at_turns() const { return largest_step(turns_); }  // that are sought [1/m]
  // Where the law turns at the turns that are sought [1/m], in the order of the rows.
  std::vector<double> turning_curvatures(const CurvePoint& point) const;

 private:
  struct LinearSolution {
    CurvePoint point;
    bool holds;  // the law is linear in b2 and g
  };
  // Moments without the zero of moment [N].
  Eigen::VectorXd law_moments(const CurvePoint& point) const;
  int zeros() const { return (beside_.moment ? 1 : 0) + (beside_.curvature ? 1 : 0); }
  int nuisances() const { return zeros() + static_cast<int>(turns_.size()); }
  Eigen::VectorXd turns_at(const CurvePoint& point) const {
    return point.nuisance.tail(static_cast<int>(turns_.size()));
  }
  double curvature_zero(const CurvePoint& point) const;  // [1/m]
  // Best b2, g and zero of moment, if they enter linearly, beside the rest of a nuisance.
  LinearSolution linear_at(double k0, const Eigen::VectorXd& nuisance) const;
  // From which the nuisance is searched: each zero of curvature that may be.
  std::vector<Eigen::VectorXd> nuisance_starts() const;

  LawRequest law_;
  std::vector<LawRow> rows_;
  Eigen::VectorXd moment_;  // measured [N]
  SoughtBeside beside_;
  std::vector<SoughtTurn> turns_;  // none where they are not sought
  double largest_;                 // moment [N]
  double curvature_, slope_;       // scales: largest curvature [1/m], moment over curvature [N m]
};

// A fit in which the three numbers follow from fewer factors, and the nuisance is free.
struct Tied {
  CurvePoint best;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  // by the logarithms of the factors, then the nuisance
  int iterations = 0;
};
// The numbers (not the nuisance) at factors on a starting point, all 1 there.
using FromFactors = std::function<CurvePoint(const Eigen::VectorXd&)>;

Tied fit_tied(const MomentModel& model, const FromFactors& numbers, int factors, const CurvePoint& start,
              SearchLimits limits = {});

}  // namespace hysteron
