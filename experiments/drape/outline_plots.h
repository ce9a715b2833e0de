// Outlines of draped specimens as files and plots: of one run, and of the same load reached along two
// histories.
#pragma once

#include <optional>
#include <vector>

#include "experiments/drape/apparatus.h"
#include "experiments/drape/outline.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

// The outlines of a drape: the one at the end and, where the ring was lifted and lowered again, that of the
// first time.
struct DrapeOutlines {
  Outline last;
  std::optional<Outline> first;
};

// outline.csv: angle [degree], radius [cm] and, of two outlines, first_radius [cm].
void write_outlines(Run& run, const DrapeOutlines& outlines);
// plot_outline: the outlines beside the pedestal and the flat specimen of this radius [m].
void plot_outlines(Session& session, const DrapeParams& choice, double radius, const DrapeOutlines& outlines);
// plot_histories of a comparison: a panel for each column that hung twice, both outlines over each other, and
// how much of them is the same.  No plot where no column did.
void plot_histories(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
