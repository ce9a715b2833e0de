// The last words of a run on the terminal: what was asked for, how sure it is, whether the cloth came to
// rest, and where the files are.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// "NOT at rest: fastest vertex 4.1 mm/s, limit 2 mm/s" where rest was asked for and not reached, by metrics
// `settled`, `fastest_m_per_s` and `settling_limit_m_per_s`; "" otherwise.
std::string not_at_rest_warning(const Metrics& metrics);

// Lines on the results that the manifest's experiment and its scene are asked for, each with its errors where
// it has them; a line for each law or fabric of several.
std::string result_words(const Manifest& manifest);

// result_words(), and the run's folder, page and pictures, as far as they are there.
std::string closing_summary(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
