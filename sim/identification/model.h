// What is measured as a function of a fabric's three numbers, and its least squares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "sim/bending/laws/law.h"

namespace hysteron {

// b2, g = b1 - b2, k0, and what else a measurement leaves open (the instrument's zero, the place of a strip).
struct CurvePoint {
  double b2 = 0, g = 0;      // [N m], >= 0
  double k0 = 0;             // [1/m]
  Eigen::VectorXd nuisance;  // of order one
  double sum = 0;            // of squared residuals

  VirginCurve curve() const { return {b2 + g, b2, k0}; }
};

class CurveModel {
 public:
  // Scales of the measurement: largest curvature [1/m], moment over curvature [N m].
  CurveModel(double curvature, double slope) : curvature_(curvature), slope_(slope) {}
  virtual ~CurveModel() = default;

  // Model minus measurement, scaled so that kBestAccuracy is what no measurement undercuts.
  virtual Eigen::VectorXd residuals(const CurvePoint& point) const = 0;
  // Where to begin: any b2, g and nuisance that are not absurd.
  virtual CurvePoint start() const = 0;
  // Best b2, g and nuisance at one k0.
  virtual CurvePoint best_at(double k0, int& iterations) const;

  // Parameters of the whole fit: logarithms of b2, g, k0 over their scales, then the nuisance.
  Eigen::VectorXd parameters(const CurvePoint& point) const;
  CurvePoint point(const Eigen::VectorXd& parameters) const;
  Eigen::VectorXd low(int size) const;
  Eigen::VectorXd high(int size) const;

  // Best at each of many k0, in rising order.
  std::vector<CurvePoint> scan(int& iterations) const;

  double largest_curvature() const { return curvature_; }

 protected:
  double curvature_, slope_;
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

Tied fit_tied(const CurveModel& model, const FromFactors& numbers, int factors, const CurvePoint& start);

inline constexpr double kSmallestRigidity = 1e-6;  // over the measurement's slope: no logarithm of zero

}  // namespace hysteron
