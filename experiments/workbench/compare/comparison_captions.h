// What the figures of a comparison show, in words from its columns' manifests.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/compare/comparison_page.h"

namespace hysteron::experiments {

// README.md of the run's folder: a caption each for sheet.png and for the plots that are there.  `experiment`
// is what the columns ran, `command` how the page was asked for.
void write_comparison_captions(Run& run, const ComparisonPage& page, const std::string& experiment,
                               const std::string& command, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
