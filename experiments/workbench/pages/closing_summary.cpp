#include "experiments/workbench/pages/closing_summary.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"

namespace hysteron::experiments {
namespace {

// Returns "86.0 % ± 0.10 step ± 0.6 mesh ± 0.8 draw"; "" if the run has no such number.
std::string shown_value(const Headline& headline, const Metrics& metrics) {
  const MetricValue& value = metrics[headline.metric];
  if (value.is_text()) return value.text();
  return value.is_number() ? headline_text(metrics, headline).text() : "";
}

std::string row(const std::string& words, const std::string& value) {
  constexpr std::size_t kColumn = 30;
  return "  " + words + std::string(words.size() < kColumn ? kColumn - words.size() : 1, ' ') + value + "\n";
}

// A requested result: "recovery angle", "86.0 degree".
using Finding = std::pair<std::string, std::string>;

// Returns the headlines of the manifest's experiment and the metrics that its scene requests, if they are
// among `metrics`.
std::vector<Finding> findings_in(const Manifest& manifest, const Metrics& metrics) {
  std::vector<Finding> findings;
  for (const Headline& headline : column_headlines(manifest))
    findings.emplace_back(headline.words, shown_value(headline, metrics));
  for (const std::string& name : manifest.requested_metrics)
    if (metrics.contains(name))
      findings.emplace_back(split_unit(name).name, metric_text(metrics, name).text());
  std::erase_if(findings, [](const Finding& finding) { return finding.second.empty(); });
  return findings;
}

std::string one_line(const Manifest& manifest, const Metrics& metrics) {
  std::string text;
  for (const auto& [words, value] : findings_in(manifest, metrics))
    text += (text.empty() ? "" : "; ") + words + " " + value;
  const std::string rest_warning = not_at_rest_warning(metrics);
  return text + (text.empty() || rest_warning.empty() ? "" : "; ") + rest_warning;
}

// Returns why a manifest is incomplete; a study counts its runs (experiments/sweep).
std::string incomplete_reason(const Metrics& metrics) {
  const MetricValue &all = metrics["runs_count"], &failed = metrics["failed_count"];
  if (!all.is_number() || !failed.is_number() || failed.number() == 0)
    return "the run did not come to its end";
  return fmt::format("{:.0f} of {:.0f} runs did not come to their end", failed.number(), all.number());
}

}  // namespace

std::string not_at_rest_warning(const Metrics& metrics) {
  if (!metrics["settled"].is(false)) return "";
  std::string text = "NOT at rest";
  const MetricValue &fastest = metrics["fastest_m_per_s"], &limit = metrics["settling_limit_m_per_s"];
  if (fastest.is_number()) text += fmt::format(": fastest vertex {:.3g} mm/s", 1e3 * fastest.number());
  if (fastest.is_number() && limit.is_number())
    text += fmt::format(", limit {:.3g} mm/s", 1e3 * limit.number());
  return text;
}

std::string result_text(const Manifest& manifest) {
  const Metrics& metrics = manifest.metrics;
  std::string text;
  for (const auto& [words, value] : findings_in(manifest, metrics)) text += row(words, value);
  for (const auto& [name, own] : columns_in(metrics)) {
    const std::string line = one_line(manifest, own);
    if (!line.empty()) text += row(name, line);
  }
  const std::string rest_warning = not_at_rest_warning(metrics);
  if (!rest_warning.empty()) text += "  " + rest_warning + "\n";
  if (metrics["settled"].is(true)) text += "  at rest\n";
  if (!manifest.complete) text += "  INCOMPLETE: " + incomplete_reason(metrics) + "\n";
  return text;
}

std::string closing_summary(const std::filesystem::path& folder) {
  const Manifest manifest = read_manifest(folder / "manifest.json");
  const std::string fabric = manifest.text("fabric.name");
  std::string text = manifest.experiment;
  if (!fabric.empty()) text += ": " + fabric;
  if (manifest.law) text += (fabric.empty() ? ": law " : ", law ") + *manifest.law;
  text += "\n" + result_text(manifest) + row("folder", folder.string());
  const std::pair<const char*, const char*> places[] = {
      {"report", "report.html"}, {"contact sheet", "sheet.png"}, {"picture sequence", "frames"}};
  for (const auto& [words, name] : places)
    if (std::filesystem::exists(folder / name)) text += row(words, (folder / name).string());
  return text;
}

}  // namespace hysteron::experiments
