#include "experiments/workbench/pages/manifest.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "experiments/workbench/pages/gallery_about.h"

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

ShownQuantity shown_quantity(const MetricValue& value, const std::string& unit) {
  if (!value.is_number() || value.is_integer()) return {shown(value), unit};
  static const std::set<std::string> kPrefixed = {"m", "N", "J", "s", "N m", "J/m²", "m/s"};
  static constexpr const char* kPrefixes[] = {"p", "n", "µ", "m", "", "k", "M"};
  constexpr int kNone = 4, kLast = 6;
  constexpr double kZero = 1e-12;
  double number = value.number();
  if (!kPrefixed.contains(unit)) return {fmt::format("{:.4g}", number), unit};
  if (std::abs(number) < kZero) return {"0", unit};
  int prefix = kNone;
  for (; std::abs(number) < 1 && prefix > 0; --prefix) number *= 1e3;
  for (; std::abs(number) >= 1e3 && prefix < kLast; ++prefix) number /= 1e3;
  return {fmt::format("{:.4g}", number), kPrefixes[prefix] + unit};
}

std::string ShownQuantity::more() const { return joined({unit, errors}, " "); }

std::string ShownQuantity::text() const { return joined({value, more()}, " "); }

bool is_numerics(const std::string& key) {
  static const std::set<std::string> kOthers = {"parts_count",
                                                "integrator_share_percent",
                                                "sharp_edges_percent",
                                                "residual_curvature_formula_rms_per_m",
                                                "setup_seconds",
                                                "fastest_m_per_s",
                                                "settling_limit_m_per_s",
                                                "hand_lag_m",
                                                "settled"};
  const auto ends = [&](const char* ending) { return key.ends_with(ending); };
  return ends("_per_step") || ends("steps_count") || ends("_relative") || key.starts_with("newton_") ||
         (key.starts_with("recovery_") && ends("_count")) || kOthers.contains(key);
}

std::string state_badge(const Manifest& manifest) {
  return manifest.complete ? "<span class=\"state\">complete</span>"
                           : "<span class=\"state bad\">incomplete</span>";
}

std::string program_description(const Manifest& manifest) {
  return "hysteron " + manifest.version + ", commit " + manifest.commit.substr(0, 12) +
         (manifest.dirty ? ", modified" : "");
}

}  // namespace hysteron::experiments
