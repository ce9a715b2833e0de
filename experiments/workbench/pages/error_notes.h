// Formats headline numbers with their errors, from the metrics of a manifest:
//   "drape coefficient 86.0 % ± 0.10 step ± 0.6 mesh ± 0.8 draw".
#pragma once

#include <string>

#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/pages/manifest.h"

namespace hysteron::experiments {

// The endings of the metrics that errors.h adds to a headline.
inline constexpr const char* kStepError = "_step_error";
inline constexpr const char* kMeshError = "_mesh_error";
inline constexpr const char* kDrawError = "_draw_error";
inline constexpr const char* kDrawMean = "_mean";
inline constexpr const char* kDrawMeanError = "_mean_stderr";
inline constexpr const char* kPathDifference = "_path_difference";
// The ending of the standard error of a fitted number.
inline constexpr const char* kStandardError = "_stderr";

// True if the metric's errors were measured.
bool is_headline(const Metrics& metrics, const std::string& name);
// Returns the headline of which this metric is an error, a mean or a difference; "" if there is none.
std::string described_headline(const Metrics& metrics, const std::string& name);

// Formats a headline in parts.  Errors have one significant digit, two if the first is 1, and the value ends
// at the decimal of the largest.  An error that could not be measured is marked as unknown.
ShownQuantity headline_text(const Metrics& metrics, const std::string& name);
// Formats in the headline's unit; without measured errors, with the standard error of its fit, or alone.
ShownQuantity headline_text(const Metrics& metrics, const Headline& headline);

// Marks a result of cloth that should have come to rest and did not, because its shape cannot be measured.
ShownQuantity with_rest_warning(ShownQuantity words, const Metrics& metrics, const std::string& name);

// Returns name, value, unit and errors in one line; without errors for a number that is no headline.
std::string with_errors(const Metrics& metrics, const std::string& name);

}  // namespace hysteron::experiments
