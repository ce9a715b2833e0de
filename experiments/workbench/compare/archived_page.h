// Keeps the data of a comparison's page in one file, and reads it back.
#pragma once

#include <vector>

#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/pictures/archived_geometry.h"

namespace hysteron::experiments {

// Writes sheet.hyg: for each column the kept geometry of these of its frames, in ascending order, its
// manifest and why it stopped; columns on one mesh share it.  Columns that kept nothing are left out.
void keep_page(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns,
               const std::vector<std::vector<int>>& frames);

// `is_page` is true if `sheet` is that of a comparison; `kept_comparison_page` reads it.
bool is_page(const Json& sheet);
ComparisonPage archived_comparison_page(const Json& sheet);
// Returns the column whose pictures were drawn again into that folder, described by `frames`.
ChildRun redrawn_column(const ArchivedCloth& cloth, const std::filesystem::path& folder,
                        const std::optional<Frames>& frames);

}  // namespace hysteron::experiments
