#include "experiments/workbench/pages/closing_words.h"

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "experiments/workbench/pages/error_words.h"
#include "experiments/workbench/pages/manifest.h"

namespace hysteron::experiments {
namespace {

// A result that an experiment is asked for.
struct Headline {
  const char* experiment;
  const char* metric;
  const char* words;
  const char* unit;
  const char* format;
  double scale = 1;  // from the metric's unit to the one that is shown
};

// clang-format off
constexpr Headline kHeadlines[] = {
    {"drape", "drape_coefficient_percent", "drape coefficient", "%", "%.1f"},
    {"drape", "published_drape_coefficient_percent", "published coefficient", "%", "%.1f"},
    {"drape", "node_count", "folds", "", "%.0f"},
    {"drape", "published_node_count", "published folds", "", "%.0f"},
    {"crease", "recovery_angle_deg", "recovery angle", "degree", "%.1f"},
    {"crease", "law_recovery_angle_deg", "that of the law alone", "degree", "%.1f"},
    {"crease", "residual_curvature_per_m", "residual curvature", "1/m", "%.4g"},
    {"fold", "recovery_angle_deg", "recovery angle", "degree", "%.1f"},
    {"fold", "2HB_N", "2HB", "mN", "%.4g", 1e3},
    {"fold", "set_curvature_per_m", "set", "1/m", "%.4g"},
    {"crumple", "residual_curvature_rms_per_m", "residual curvature (rms)", "1/m", "%.4g"},
    {"crumple", "ridge_length_m", "length of ridges", "mm", "%.1f", 1e3},
    {"crumple", "intersections", "pairs of triangles that cross", "", "%.0f"},
    {"swing", "decay_shape", "decay", "", ""},
    {"swing", "decay_exponent", "exponent of decay", "", "%.2f"},
    {"swing", "decay_per_turn_percent", "decay per turn", "%", "%.1f"},
    {"swing", "turns", "turns", "", "%.0f"},
    {"swing", "bending_friction_J", "lost to friction in bending", "mJ", "%.4g", 1e3},
    {"swing", "viscous_J", "lost to viscosity", "mJ", "%.4g", 1e3},
    {"cantilever", "tip_drop_over_length", "tip drop over length", "", "%.4f"},
    {"cantilever", "elastica_drop_over_length", "that of the elastica", "", "%.4f"},
    {"cantilever", "bending_length_m", "bending length", "mm", "%.2f", 1e3},
    {"buckle", "critical_gamma", "critical gamma", "", "%.3f"},
    {"buckle", "reference_gamma", "that of theory", "", "%.3f"},
    {"validate", "drape_coefficient_percent", "drape coefficient", "%", "%.1f"},
    {"validate", "node_count", "folds", "", "%.0f"},
    {"validate", "bending_length_m", "bending length", "mm", "%.2f", 1e3},
    {"render", "frames_count", "frames", "", "%.0f"},
};
// clang-format on

// Endings of metrics that say how far another one may be off, and what they are from.
constexpr std::pair<const char*, const char*> kErrors[] = {
    {"_stderr", ""}, {kStepError, " (step)"}, {kMeshError, " (mesh)"}, {kDrawError, " (draw)"}};

std::string formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// "86.0 ± 0.8 (step) ± 0.6 (mesh) %"; "" where the run has no such number.
std::string value_words(const Headline& headline, const std::string& key, const Json& metrics) {
  const Json value = metrics.value(key, Json());
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return "";
  std::string text = formatted(headline.format, headline.scale * value.get<double>());
  for (const auto& [ending, from] : kErrors) {
    const Json error = metrics.value(key + ending, Json());
    if (error.is_number())
      text += " ± " + formatted("%.2g", headline.scale * std::abs(error.get<double>())) + from;
  }
  return text + (*headline.unit ? std::string(" ") + headline.unit : "");
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
  for (const Headline& headline : kHeadlines) {
    if (experiment != headline.experiment) continue;
    const std::string value = value_words(headline, headline.metric, metrics);
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
  if (fastest.is_number()) text += ": fastest vertex " + formatted("%.3g mm/s", 1e3 * fastest.get<double>());
  if (fastest.is_number() && limit.is_number())
    text += ", limit " + formatted("%.3g mm/s", 1e3 * limit.get<double>());
  return text;
}

std::string result_words(const Json& manifest) {
  const Json metrics = manifest.value("metrics", Json::object());
  const std::string experiment = question_of(manifest);
  std::string text;
  for (const Headline& headline : kHeadlines) {
    if (experiment != headline.experiment) continue;
    const std::string value = value_words(headline, headline.metric, metrics);
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
