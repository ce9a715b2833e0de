// Tables of a study (`hysteron sweep`), as pieces of its page, from the CSV files in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// What the study asked for, by the manifest: the keys that its runs share, and the axes.
std::string study_keys(const Manifest& manifest);
// means.csv; "" where there is none.
std::string study_means(const std::filesystem::path& folder);
// Of table.csv: the runs that are not complete, and why; "" if all are.
std::string study_failures(const std::filesystem::path& folder);
// A row for each run, folded away: its name, the metrics that means.csv has, or all that differ, and the
// time.
std::string study_runs(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
