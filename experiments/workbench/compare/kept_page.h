// What a comparison's page was drawn from, in one file, and back.
#pragma once

#include <vector>

#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/pictures/kept_geometry.h"

namespace hysteron::experiments {

// Writes sheet.hyg: of each column what it kept of these of its frames, in ascending order, its manifest and
// why it stopped; columns on one mesh have it once.  Columns that kept nothing are left out.
void keep_page(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns,
               const std::vector<std::vector<int>>& frames);

// The page of a kept comparison; it is of one if `sheet` has it.
bool is_page(const Json& sheet);
ComparisonPage kept_comparison_page(const Json& sheet);
// The column whose pictures were drawn again into that folder, as `frames` say.
ChildRun redrawn_column(const KeptCloth& cloth, const std::filesystem::path& folder,
                        const std::optional<Frames>& frames);

}  // namespace hysteron::experiments
