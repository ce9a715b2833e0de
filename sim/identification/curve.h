// b1, b2 and k0 of a law from a measured moment-curvature curve.
#pragma once

#include "sim/identification/identification.h"
#include "sim/identification/model.h"
#include "sim/identification/series.h"

namespace hysteron {

// A law's moments along a measured series.
class MomentModel : public CurveModel {
 public:
  // `law`: its curve is ignored.  `offset`: the instrument's zero over the largest moment is the nuisance.
  // `cycling`: as law_rows().  Throws Error::invalid_input as run_law() does.
  MomentModel(const MomentSeries& series, const LawRequest& law, bool offset, bool cycling);

  // Moments of the law at the series' rows [N], the offset added; not a number where the law does not take
  // the numbers.
  Eigen::VectorXd moments(const CurvePoint& point) const;

  Eigen::VectorXd residuals(const CurvePoint& point) const override;  // over the largest moment
  CurvePoint start() const override;
  // Solved at once for laws whose moment is linear in b2 and g: all whose friction is a fixed shape.
  CurvePoint best_at(double k0, int& iterations) const override;

 private:
  LawRequest law_;
  std::vector<LawRow> rows_;
  Eigen::VectorXd moment_;  // measured [N]
  bool offset_;
  double largest_;  // [N]
};

struct CurveQuestion {
  LawRequest law;       // whose name and parameters are taken; its curve is sought
  bool offset = false;  // the instrument's zero is sought, too
  Assumptions assumptions;
};

// Least squares of moments: a scan over k0 (on which alone the shape depends, so that it finds the best
// valley and shows which k0 the data exclude), then all parameters together.  What stays undetermined, by the
// curvature of the sum of squares or by the scan, is replaced by an assumption that describes the data as
// well, if there is one.  The history before the first row is the virgin cloth's or, where that describes the
// data better by more than noise, that of the same cycles.
Identification identify_curve(const MomentSeries& series, const CurveQuestion& question);

}  // namespace hysteron
