#include "experiments/workbench/pages/manifest.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace hysteron::experiments {
std::string shown(const MetricValue& value) {
  if (!value.is_known()) return "–";
  if (value.is(true)) return "yes";
  if (value.is(false)) return "no";
  if (value.is_integer()) return std::to_string(std::get<std::int64_t>(value.variant()));
  return value.is_number() ? fmt::format("{:g}", value.number()) : value.text();
}

NamedUnit split_unit(std::string key) {
  static const std::vector<std::pair<std::string, std::string>> kEndings = {
      {"_J_per_m2", "J/m²"}, {"_m_per_s", "m/s"}, {"_percent", "%"}, {"_per_m", "1/m"}, {"_N_m", "N m"},
      {"_deg", "°"},         {"_rad", "rad"},     {"_ms", "ms"},     {"_mm", "mm"},     {"_N", "N"},
      {"_J", "J"},           {"_m", "m"},         {"_s", "s"}};
  std::string unit;
  for (const auto& [ending, symbol] : kEndings) {
    if (!key.ends_with(ending) || key.size() == ending.size()) continue;
    key.resize(key.size() - ending.size());
    unit = symbol;
    break;
  }
  std::replace(key.begin(), key.end(), '_', ' ');
  return {key, unit};
}

std::string metric_text(const std::string& key, double value) {
  const NamedUnit what = split_unit(key);
  return fmt::format("{} {:.4g}{}{}", what.name, value, what.unit.empty() ? "" : " ", what.unit);
}

std::string state_badge(const Manifest& manifest) {
  return manifest.complete ? "<span class=\"state\">complete</span>"
                           : "<span class=\"state bad\">incomplete</span>";
}

std::string program_of(const Manifest& manifest) {
  return "hysteron " + manifest.version + ", commit " + manifest.commit.substr(0, 12) +
         (manifest.dirty ? ", modified" : "");
}

}  // namespace hysteron::experiments
