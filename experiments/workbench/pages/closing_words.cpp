#include "experiments/workbench/pages/closing_words.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "experiments/workbench/pages/error_words.h"
#include "experiments/workbench/pages/manifest.h"

namespace hysteron::experiments {
namespace {

// "86.0 % ± 0.10 step ± 0.6 mesh ± 0.8 draw"; "" where the run has no such number.
std::string value_words(const Headline& headline, const Json& metrics) {
  const Json value = metrics.value(headline.metric, Json());
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? headline_words(metrics, headline).text() : "";
}

std::string row(const std::string& words, const std::string& value) {
  constexpr std::size_t kColumn = 30;
  return "  " + words + std::string(words.size() < kColumn ? kColumn - words.size() : 1, ' ') + value + "\n";
}

// What a comparison's columns were asked for.
std::string question_of(const Json& manifest) {
  const std::string own = manifest.value("experiment", "");
  return own == "compare" ? manifest.at("scene").value("compared", own) : own;
}

// Laws or fabrics whose metrics are called NAME.KEY, in their order.
std::vector<std::string> names_in(const Json& metrics) {
  std::vector<std::string> names;
  for (const auto& [key, value] : metrics.items()) {
    const std::size_t dot = key.rfind('.');
    if (dot == key.npos) continue;
    const std::string name = key.substr(0, dot);
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

Json metrics_of(const std::string& name, const Json& metrics) {
  Json own = Json::object();
  for (const auto& [key, value] : metrics.items())
    if (key.starts_with(name + ".")) own[key.substr(name.size() + 1)] = value;
  return own;
}

std::string one_line(const std::string& experiment, const Json& metrics) {
  std::string text;
  for (const Headline& headline : headlines_of(experiment).all) {
    const std::string value = value_words(headline, metrics);
    if (!value.empty()) text += (text.empty() ? "" : "; ") + std::string(headline.words) + " " + value;
  }
  const std::string unrest = unrest_words(metrics);
  return text + (text.empty() || unrest.empty() ? "" : "; ") + unrest;
}

}  // namespace

std::string unrest_words(const Json& metrics) {
  if (!metrics.is_object() || metrics.value("settled", Json()) != Json(false)) return "";
  std::string text = "NOT at rest";
  const Json fastest = metrics.value("fastest_m_per_s", Json()),
             limit = metrics.value("settling_limit_m_per_s", Json());
  if (fastest.is_number()) text += fmt::format(": fastest vertex {:.3g} mm/s", 1e3 * fastest.get<double>());
  if (fastest.is_number() && limit.is_number())
    text += fmt::format(", limit {:.3g} mm/s", 1e3 * limit.get<double>());
  return text;
}

std::string result_words(const Json& manifest) {
  const Json metrics = manifest.value("metrics", Json::object());
  const std::string experiment = question_of(manifest);
  std::string text;
  for (const Headline& headline : headlines_of(experiment).all) {
    const std::string value = value_words(headline, metrics);
    if (!value.empty()) text += row(headline.words, value);
  }
  for (const std::string& name : names_in(metrics)) {
    const std::string line = one_line(experiment, metrics_of(name, metrics));
    if (!line.empty()) text += row(name, line);
  }
  const std::string unrest = unrest_words(metrics);
  if (!unrest.empty()) text += "  " + unrest + "\n";
  if (metrics.value("settled", Json()) == Json(true)) text += "  at rest\n";
  if (!manifest.value("complete", false)) text += "  INCOMPLETE: the run did not come to its end\n";
  return text;
}

std::string closing_words(const std::filesystem::path& folder) {
  const Json manifest = read_manifest(folder / "manifest.json");
  const std::string fabric = fabric_name(manifest);
  const Json law = manifest.value("law", Json());
  std::string text = manifest.value("experiment", "run");
  if (!fabric.empty()) text += ": " + fabric;
  if (law.is_string()) text += (fabric.empty() ? ": law " : ", law ") + law.get<std::string>();
  text += "\n" + result_words(manifest) + row("folder", folder.string());
  const std::pair<const char*, const char*> places[] = {
      {"report", "report.html"}, {"contact sheet", "sheet.png"}, {"picture sequence", "frames"}};
  for (const auto& [words, name] : places)
    if (std::filesystem::exists(folder / name)) text += row(words, (folder / name).string());
  return text;
}

}  // namespace hysteron::experiments
