// Tables of a run, series among them, beside those of its repetition.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/verify/repetition.h"

namespace hysteron::experiments {

// Each column of a table is held to what its numbers may differ by, in the row where they differ most: to the
// limit on its name, "metrics.csv:plate_force [N]", or the limit or stated error of the metric that it is the
// history of (plate_force_N), or else to round-off of the column's largest number.  Energies [J] of one table
// share the largest of all.  Columns of durations are passed over.  Other words, other rows, a table or
// column that the repetition lacks, and a column that the record lacks are differences; but a later program
// may write columns that nobody asked the run for.
void compare_tables(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                    const std::filesystem::path& now, const Manifest& manifest, const Manifest& manifest_now,
                    const Limits& limits, Repetition& repetition);

// Names of the columns of a table, as limits have them.
struct TableColumns {
  std::vector<std::string> compared, durations;
};
TableColumns table_columns(const std::string& file, const std::filesystem::path& folder);

}  // namespace hysteron::experiments
