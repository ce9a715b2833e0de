// How headline numbers are written with their errors, from the metrics of a manifest:
//   "drape coefficient 86.0 % ± 0.10 step ± 0.6 mesh ± 0.8 draw".
#pragma once

#include <string>

#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/pages/manifest.h"

namespace hysteron::experiments {

// Endings of the metrics that errors.h adds to a headline.
inline constexpr const char* kStepError = "_step_error";
inline constexpr const char* kMeshError = "_mesh_error";
inline constexpr const char* kDrawError = "_draw_error";
inline constexpr const char* kDrawMean = "_mean";
inline constexpr const char* kDrawMeanError = "_mean_stderr";
inline constexpr const char* kPathDifference = "_path_difference";
// Of what the experiment fits itself.
inline constexpr const char* kStandardError = "_stderr";

// Whether the metric's errors were asked for.
bool is_headline(const Metrics& metrics, const std::string& name);
// The headline that this metric is an error, a mean or a difference of; "" if none.
std::string described_headline(const Metrics& metrics, const std::string& name);

// A headline in parts.  Errors have one significant digit, two if the first is 1, and the value ends where
// the largest of them does.  An error that could not be measured is said to be unknown.
ShownQuantity headline_words(const Metrics& metrics, const std::string& name);
// In the unit that the headline is shown in; where no errors were asked for, with the standard error of its
// fit, or alone.
ShownQuantity headline_words(const Metrics& metrics, const Headline& headline);

// Words on a result of cloth that should have come to rest and did not are marked as such: its shape is none
// that could be measured.
ShownQuantity with_rest_warning(ShownQuantity words, const Metrics& metrics, const std::string& name);

// Name, value, unit and errors in one line; without errors for a number that is no headline.
std::string with_errors(const Metrics& metrics, const std::string& name);

}  // namespace hysteron::experiments
