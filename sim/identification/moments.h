// A law's moments along a measured series.
#pragma once

#include "sim/identification/model.h"
#include "sim/identification/series.h"

namespace hysteron {

class MomentModel : public CurveModel {
 public:
  // `law`: its curve is ignored.  `offset`: the instrument's zero over the largest moment is the nuisance.
  // `cycling`: as law_rows().  Throws Error::request as run_law() does.
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

}  // namespace hysteron
