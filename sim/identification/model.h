// A measured series of moments as a function of a fabric's three numbers, and its least squares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "sim/identification/series.h"

namespace hysteron {

// The instrument's zeros that are sought, too.
struct SoughtZeros {
  bool moment = false, curvature = false;

  int count() const { return (moment ? 1 : 0) + (curvature ? 1 : 0); }
};

// b2, g = b1 - b2, k0, and the instrument's zeros where they are sought, too.
struct CurvePoint {
  double b2 = 0, g = 0;      // [N m], >= 0
  double k0 = 0;             // [1/m]
  Eigen::VectorXd nuisance;  // zeros that are sought: of moment, of curvature, over the largest of the data
  double sum = 0;            // of squared residuals

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
  MomentModel(const MomentSeries& series, const LawRequest& law, SoughtZeros zeros, bool cycling);

  // Moments of the law at the series' rows [N] less the zero of curvature, the zero of moment added; not a
  // number where the law does not take the numbers.
  Eigen::VectorXd moments(const CurvePoint& point) const;
  // Model minus measurement over the largest moment.
  Eigen::VectorXd residuals(const CurvePoint& point) const;
  // Best b2, g and nuisance at one k0.  Solved at once for laws whose moment is linear in b2 and g: all whose
  // friction is a fixed shape, unless the zero of curvature is sought.
  CurvePoint best_at(double k0, int& iterations) const;

  // Which numbers change no moment of the law here: it does not read them.
  UnreadNumbers unread(const CurvePoint& point) const;

  // Parameters of the whole fit: logarithms of b2, g, k0 over their scales, then the nuisance.
  Eigen::VectorXd parameters(const CurvePoint& point) const;
  CurvePoint point(const Eigen::VectorXd& parameters) const;
  // Bounds of so many of them, low and high.
  static std::pair<Eigen::VectorXd, Eigen::VectorXd> bounds(int size);

  // Best at each of many k0, in rising order.
  std::vector<CurvePoint> scan(int& iterations) const;

  double largest_curvature() const { return curvature_; }

 private:
  struct LinearSolution {
    CurvePoint point;
    bool holds;  // the law is linear in b2 and g
  };
  // Moments without the zero of moment [N].
  Eigen::VectorXd law_moments(const CurvePoint& point) const;
  Eigen::VectorXd zeros_at(double curvature_zero) const;  // that of moment being 0
  // Best b2, g and zero of moment, if they enter linearly, at a zero of curvature over the largest one.
  LinearSolution linear_at(double k0, double curvature_zero) const;
  // Where the zero of curvature may be, over the largest curvature.
  std::vector<double> curvature_zeros() const;
  // Best at one k0 by iterations, from a point there.
  CurvePoint searched_from(const CurvePoint& begin, int& iterations) const;

  LawRequest law_;
  std::vector<LawRow> rows_;
  Eigen::VectorXd moment_;  // measured [N]
  SoughtZeros zeros_;
  double largest_;            // moment [N]
  double curvature_, slope_;  // scales: largest curvature [1/m], moment over curvature [N m]
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

Tied fit_tied(const MomentModel& model, const FromFactors& numbers, int factors, const CurvePoint& start);

}  // namespace hysteron
