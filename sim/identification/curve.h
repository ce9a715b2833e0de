// b1, b2 and k0 of a law from a measured moment-curvature curve.
#pragma once

#include "sim/identification/identification.h"
#include "sim/identification/series.h"

namespace hysteron {

struct CurveQuestion {
  LawRequest law;       // whose name and parameters are taken; its curve is sought
  bool offset = false;  // the instrument's zero of moment is sought, too
  Assumptions assumptions;
  bool curvature_offset = false;  // and that of curvature
};

// Least squares of moments: a scan over k0 (on which alone the shape depends, so that it finds the best
// valley and shows which k0 the data exclude), then all parameters together.  What stays undetermined, by the
// curvature of the sum of squares or by the scan, is replaced by an assumption that describes the data as
// well, if there is one.  The history before the first row is the virgin cloth's or, where that describes the
// data better by more than noise, that of the same cycles.
Identification identify_curve(const MomentSeries& series, const CurveQuestion& question);

}  // namespace hysteron
