// Compares tables of a run, including series, with those of its repetition.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/verify/repetition.h"

namespace hysteron::experiments {

// Compares each column of a table in the row where it differs most, with the limit on its name,
// "metrics.csv:plate_force [N]", or the limit or stated error of the metric whose history it is
// (plate_force_N), or else with round-off of the column's largest number.  Energies [J] of one table share
// the largest of all.  Columns of durations are skipped.  Other words, other rows, a table or column that the
// repetition lacks, and a column that the record lacks are differences; but a later program may write columns
// that nobody requested.
void compare_tables(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                    const std::filesystem::path& now, const Manifest& manifest, const Manifest& manifest_now,
                    const Limits& limits, Repetition& repetition);

// Returns the names of the columns of a table, as limits use them.
struct TableColumns {
  std::vector<std::string> compared, durations;
};
TableColumns table_columns(const std::string& file, const std::filesystem::path& folder);

}  // namespace hysteron::experiments
