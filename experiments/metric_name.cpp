#include "experiments/metric_name.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

namespace hysteron::experiments {

NamedUnit split_unit(std::string key) {
  static const std::vector<std::pair<std::string, std::string>> kEndings = {
      {"_J_per_m2", "J/m²"}, {"_percent", "%"}, {"_per_m", "1/m"}, {"_N_m", "N m"},
      {"_deg", "°"},         {"_rad", "rad"},   {"_ms", "ms"},     {"_mm", "mm"},
      {"_N", "N"},           {"_J", "J"},       {"_m", "m"},       {"_s", "s"}};
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
  char text[40];
  std::snprintf(text, sizeof text, " %.4g", value);
  return what.name + text + (what.unit.empty() ? "" : " " + what.unit);
}

}  // namespace hysteron::experiments
