// A measured series of moments as a function of a fabric's three numbers, and its least squares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "sim/identification/series.h"

namespace hysteron {

// b2, g = b1 - b2, k0, and the instrument's zero where it is sought, too.
struct CurvePoint {
  double b2 = 0, g = 0;      // [N m], >= 0
  double k0 = 0;             // [1/m]
  Eigen::VectorXd nuisance;  // none, or the zero over the largest moment
  double sum = 0;            // of squared residuals

  VirginCurve curve() const { return {b2 + g, b2, k0}; }
};

// A law's moments along a measured series.
class MomentModel {
 public:
  // `law`: its curve is ignored.  `offset`: the instrument's zero is sought.  `cycling`: as law_rows().
  // Throws Error::invalid_input as run_law() does.
  MomentModel(const MomentSeries& series, const LawRequest& law, bool offset, bool cycling);

  // Moments of the law at the series' rows [N], the offset added; not a number where the law does not take
  // the numbers.
  Eigen::VectorXd moments(const CurvePoint& point) const;
  // Model minus measurement over the largest moment.
  Eigen::VectorXd residuals(const CurvePoint& point) const;
  // Best b2, g and nuisance at one k0.  Solved at once for laws whose moment is linear in b2 and g: all whose
  // friction is a fixed shape.
  CurvePoint best_at(double k0, int& iterations) const;

  // Parameters of the whole fit: logarithms of b2, g, k0 over their scales, then the nuisance.
  Eigen::VectorXd parameters(const CurvePoint& point) const;
  CurvePoint point(const Eigen::VectorXd& parameters) const;
  // Bounds of so many of them, low and high.
  static std::pair<Eigen::VectorXd, Eigen::VectorXd> bounds(int size);

  // Best at each of many k0, in rising order.
  std::vector<CurvePoint> scan(int& iterations) const;

  double largest_curvature() const { return curvature_; }

 private:
  Eigen::VectorXd no_offset() const { return Eigen::VectorXd::Zero(offset_ ? 1 : 0); }
  // The same by iterations, from an elastic and a frictional part of half the slope each.
  CurvePoint searched_at(double k0, int& iterations) const;

  LawRequest law_;
  std::vector<LawRow> rows_;
  Eigen::VectorXd moment_;  // measured [N]
  bool offset_;
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
