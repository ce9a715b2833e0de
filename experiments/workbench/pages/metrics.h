// Formats a run's metrics as pieces of a page; headlines have their errors.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/pages/error_notes.h"

namespace hysteron::experiments {

// Returns the laws, fabrics or others whose metrics are called NAME.KEY, in their order, each with its own.
std::vector<std::pair<std::string, Metrics>> columns_in(const Metrics& metrics);

// Returns the headlines of each column: for a comparison those of the experiment that it compares.
const std::vector<Headline>& column_headlines(const Manifest& manifest);

// Returns value, unit and, for a headline, errors of any metric.
ShownQuantity metric_text(const Metrics& metrics, const std::string& key);

// Returns cards with the metrics of the run itself.
std::string metric_cards(const Metrics& metrics);
// Returns cards with the experiment's headlines, in their words and units; for a few laws or fabrics a card
// each with the first headline.  "" if the run has none.
std::string answer_cards(const Manifest& manifest);
// Returns the first of these in a line: "108 ± 0.1° recovery angle".
std::string first_answer(const Manifest& manifest);
// Return the other metrics: those about the cloth, and those about the solver.
Metrics further_metrics(const Manifest& manifest);
Metrics numerics(const Metrics& metrics);
// Returns metrics of several laws or fabrics, "prandtl.2HB_N", with a row for each and a column for each
// metric.  "" if there are none.
std::string metric_table(const Metrics& metrics);
// Returns why some errors of the manifest's headlines are unknown; "" if all are known.
std::string missing_errors(const Manifest& manifest);

}  // namespace hysteron::experiments
