// Identifies b1, b2 and k0 of a law from a measured moment-curvature curve.
#pragma once

#include "sim/identification/identification.h"
#include "sim/identification/series.h"

namespace hysteron {

struct CurveQuestion {
  LawRequest law;       // name and parameters are used; its curve is sought
  bool offset = false;  // seeks the instrument's zero of moment, too
  Assumptions assumptions;
  bool curvature_offset = false;  // seeks that of curvature
};

// Minimises the squares of moments: a scan over k0 (the only number on which the shape depends, so that it
// finds the best valley and shows which k0 the data exclude), then a search of all parameters together.  A
// number that stays undetermined, by the curvature of the sum of squares or by the scan, is replaced by an
// assumption that describes the data as well, if there is one.  The history before the first row is the
// virgin cloth's or, if that describes the data better by more than noise, that of the same cycles.
Identification identify_curve(const MomentSeries& series, const CurveQuestion& question);

}  // namespace hysteron
