// Formats the summary of a run on the terminal: its results with errors, whether the cloth came to rest, and
// where the files are.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Returns "NOT at rest: fastest vertex 4.1 mm/s, limit 2 mm/s" if rest was requested and not reached, by
// metrics `settled`, `fastest_m_per_s` and `settling_limit_m_per_s`; "" otherwise.
std::string not_at_rest_warning(const Metrics& metrics);

// Returns a line for each headline of the manifest's experiment and its scene, with its errors if known;
// several laws or fabrics have a line each.
std::string result_text(const Manifest& manifest);

// Returns result_text(), and the run's folder, page and pictures, if they exist.
std::string closing_summary(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
