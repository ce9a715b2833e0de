// A run's metrics as pieces of a page; headlines stand there with their errors.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/pages/error_words.h"

namespace hysteron::experiments {

// Laws, fabrics or others whose metrics are called NAME.KEY, in their order, each with its own.
std::vector<std::pair<std::string, Metrics>> columns_in(const Metrics& metrics);

// What each of them is asked for: of a comparison what it compares.
const std::vector<Headline>& column_headlines(const Manifest& manifest);

// Value, unit and, for a headline, errors of any metric.
ShownQuantity metric_words(const Metrics& metrics, const std::string& key);

// Metrics of the run itself.
std::string metric_cards(const Metrics& metrics);
// What the experiment is asked for, in its own words and units; of a few laws or fabrics the first of it,
// each its own.  "" if the run has found none of it.
std::string answer_cards(const Manifest& manifest);
// The first of these in a line: "108 ± 0.1° recovery angle".
std::string first_answer(const Manifest& manifest);
// The others: what tells of the cloth, and how the solver fared.
Metrics further_metrics(const Manifest& manifest);
Metrics numerics(const Metrics& metrics);
// Metrics of several laws or fabrics, "prandtl.2HB_N": a row for each, a column for each metric.  "" if none.
std::string metric_table(const Metrics& metrics);
// Why some errors of the manifest's headlines are not known.  "" if all are.
std::string missing_errors(const Manifest& manifest);

}  // namespace hysteron::experiments
