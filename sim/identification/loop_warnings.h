// Warns of doubtful loops and laws for a fit, for `fit` and Python alike.
//
// A statement of an Identification says what the data show.  A warning says that a number may be wrong: the
// zero of curvature is off, times are missing that a law takes, a parameter is not read, or the law stays far
// from the data.
#pragma once

#include <string>
#include <vector>

#include "sim/bending/laws/law_run.h"
#include "sim/identification/identification.h"
#include "sim/identification/series.h"

namespace hysteron {

// This is a fraction of the data's range (rms): instruments repeat to some percent, and a fit that is farther
// off has another shape.
inline constexpr double kImplausibleMiss = 0.08;

// These say what is doubtful before a fit: laws that take time and rows without it, parameters that the laws
// do not read, and, unless it is sought (`seeks_curvature_offset`), a zero of curvature that seems to be off.
// The curves of the laws are ignored.  Throws Error::invalid_input as run_law() does.
std::vector<std::string> loop_warnings(const MomentSeries& series, const std::vector<LawRequest>& laws,
                                       bool seeks_curvature_offset);

// This says what is doubtful after it: how far the law stays from the data; "" where it is near them.
std::string misses_warning(const Identification& found);

}  // namespace hysteron
