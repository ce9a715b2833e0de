#include "experiments/sweep/tables.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/workbench/compare/comparison.h"

namespace hysteron::experiments {
namespace {

// Returns a number, boolean or text as a field of a table; "" for others.
std::string metric_field(const MetricValue& value) {
  if (value.is_number()) return number_text(value.number());
  if (value.is_text()) return value.text();
  return value.is(true) ? "1" : value.is(false) ? "0" : "";
}

bool has_field(const MetricValue& value) { return !metric_field(value).empty(); }

// Returns the metrics that any of the runs' scenes requests.
std::vector<std::string> requested_of_any(const std::vector<ChildRun>& runs) {
  std::vector<std::string> names;
  for (const ChildRun& run : runs)
    for (const std::string& name :
         run.manifest ? run.manifest->requested_metrics : std::vector<std::string>{})
      if (!std::count(names.begin(), names.end(), name)) names.push_back(name);
  return names;
}

bool differs(const std::vector<ChildRun>& runs, const std::string& metric) {
  std::vector<double> known = metric_values(runs, metric);
  std::erase_if(known, [](double x) { return std::isnan(x); });
  return !known.empty() && std::any_of(known.begin(), known.end(), [&](double x) { return x != known[0]; });
}

// Groups the runs' indices by their values except the seed, in the order of the first.
std::vector<std::pair<std::vector<std::string>, std::vector<std::size_t>>> study_points(const Study& study) {
  std::vector<std::pair<std::vector<std::string>, std::vector<std::size_t>>> points;
  std::map<std::vector<std::string>, std::size_t> places;
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    std::vector<std::string> values;
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      if (!is_seed(study.axes[a])) values.push_back(study.runs[r].values[a]);
    const auto [place, is_new] = places.emplace(values, points.size());
    if (is_new) points.push_back({values, {}});
    points[place->second].second.push_back(r);
  }
  return points;
}

}  // namespace

std::vector<double> metric_values(const std::vector<ChildRun>& runs, const std::string& metric) {
  std::vector<double> numbers;
  for (const ChildRun& run : runs) numbers.push_back(run.metrics().number(metric));
  return numbers;
}

Mean selected_mean(const std::vector<double>& numbers, const std::vector<std::size_t>& which) {
  Mean mean;
  double sum = 0, squares = 0;
  for (const std::size_t r : which)
    if (!std::isnan(numbers[r])) sum += numbers[r], ++mean.count;
  if (mean.count == 0) return mean;
  mean.value = sum / mean.count;
  for (const std::size_t r : which)
    if (!std::isnan(numbers[r])) squares += (numbers[r] - mean.value) * (numbers[r] - mean.value);
  if (mean.count > 1) mean.error = std::sqrt(squares / (mean.count - 1) / mean.count);
  return mean;
}

std::vector<std::string> metrics_shown(const Study& study, const std::vector<ChildRun>& runs) {
  constexpr std::size_t kFew = 4;
  const std::vector<std::string> known = metrics_in(runs, has_field);
  std::vector<std::string> wanted = study.metrics;
  if (wanted.empty()) wanted = experiment_headlines(study.experiment).with_errors();
  if (wanted.empty()) wanted = requested_of_any(runs);
  std::erase_if(wanted,
                [&](const std::string& name) { return !std::count(known.begin(), known.end(), name); });
  if (!wanted.empty()) return wanted;
  for (const std::string& name : known)
    if (wanted.size() < kFew && differs(runs, name)) wanted.push_back(name);
  return wanted;
}

std::string unknown_metric(const Study& study, std::span<const ChildRun> runs) {
  std::vector<std::string> known;
  for (const ChildRun& run : runs)
    for (const auto& [name, value] : run.metrics())
      if (!std::count(known.begin(), known.end(), name)) known.push_back(name);
  if (known.empty()) return "";
  for (const std::string& name : study.metrics) {
    if (std::count(known.begin(), known.end(), name)) continue;
    const std::string nearest = nearest_name(name, known);
    return name + " (" +
           (nearest.empty() ? "there are: " + join(known, ", ") : "did you mean " + nearest + "?") + ")";
  }
  return "";
}

Table table_of_runs(const Study& study, const std::vector<ChildRun>& runs) {
  const std::vector<std::string> metrics = metrics_in(runs, has_field);
  Table table;
  table.head = {"run"};
  for (const StudyAxis& axis : study.axes) table.head.push_back(axis.key);
  table.head.insert(table.head.end(), metrics.begin(), metrics.end());
  table.head.insert(table.head.end(), {"wall_s", "state_hash", "exit_code", "stopped"});
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::optional<Manifest>& manifest = runs[r].manifest;
    const Metrics found = runs[r].metrics();
    std::vector<std::string>& row = table.rows.emplace_back(1, study.runs[r].name);
    row.insert(row.end(), study.runs[r].values.begin(), study.runs[r].values.end());
    for (const std::string& metric : metrics) row.push_back(metric_field(found[metric]));
    const std::optional<double> seconds = manifest ? manifest->own_seconds() : std::nullopt;
    row.push_back(seconds ? number_text(*seconds) : "");
    row.push_back(manifest ? manifest->state_hash.value_or("") : "");
    row.push_back(std::to_string(runs[r].exit_code));
    row.push_back(runs[r].stopped);
  }
  return table;
}

Table table_of_means(const Study& study, const std::vector<ChildRun>& runs,
                     const std::vector<std::string>& metrics) {
  Table table;
  for (const StudyAxis& axis : study.axes)
    if (!is_seed(axis)) table.head.push_back(axis.key);
  table.head.push_back("draws");
  std::vector<std::vector<double>> numbers;
  for (const std::string& metric : metrics) {
    table.head.insert(table.head.end(), {metric + "_mean", metric + "_stderr"});
    numbers.push_back(metric_values(runs, metric));
  }
  for (const auto& [values, which] : study_points(study)) {
    std::vector<std::string>& row = table.rows.emplace_back(values);
    const auto done =
        std::count_if(which.begin(), which.end(), [&](std::size_t r) { return runs[r].exit_code == 0; });
    row.push_back(std::to_string(done));
    for (const std::vector<double>& of_metric : numbers) {
      const Mean mean = selected_mean(of_metric, which);
      row.push_back(std::isnan(mean.value) ? "" : number_text(mean.value));
      row.push_back(std::isnan(mean.error) ? "" : number_text(mean.error));
    }
  }
  return table;
}

}  // namespace hysteron::experiments
