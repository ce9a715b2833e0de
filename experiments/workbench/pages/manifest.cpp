#include "experiments/workbench/pages/manifest.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "experiments/workbench/pages/page.h"
#include "sim/base/number_in.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

// Returns "law prandtl", "laws prandtl, linear", "14 laws".
std::string named_or_counted(const std::vector<std::string>& names, const std::string& one) {
  constexpr std::size_t kMaxNames = 4;
  if (names.empty()) return "";
  if (names.size() > kMaxNames) return counted(names.size(), one);
  return one + (names.size() > 1 ? "s " : " ") + join(names, ", ");
}

// Returns the names of one fabric or several.
std::string fabric_names(const Manifest& manifest) {
  if (const std::string name = manifest.text("fabric.name"); !name.empty()) return name;
  const std::string several = named_or_counted(manifest.names("fabric"), "fabric");
  return several.starts_with("fabric ") ? several.substr(7) : several;
}

}  // namespace

std::string shown(const MetricValue& value) {
  if (!value.is_known()) return "–";
  if (value.is(true)) return "yes";
  if (value.is(false)) return "no";
  if (value.is_integer()) return std::to_string(std::get<std::int64_t>(value.variant()));
  return value.is_number() ? number_text(value.number(), 6) : value.text();
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
  if (!kPrefixed.contains(unit)) return {number_text(number, 4), unit};
  if (std::abs(number) < kZero) return {"0", unit};
  int prefix = kNone;
  for (; std::abs(number) < 1 && prefix > 0; --prefix) number *= 1e3;
  for (; std::abs(number) >= 1e3 && prefix < kLast; ++prefix) number /= 1e3;
  return {number_text(number, 4), kPrefixes[prefix] + unit};
}

std::string ShownQuantity::more() const { return joined({unit, errors}, " "); }

std::string ShownQuantity::text() const { return joined({value, more()}, " "); }

bool is_numerics(const std::string& key) {
  static const std::set<std::string> kOthers = {"parts_count",
                                                "integrator_share_percent",
                                                "sharp_edges_percent",
                                                "tilted_triangles_percent",
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

std::string joined(std::vector<std::string> texts, const std::string& between) {
  std::erase(texts, "");
  return join(texts, between);
}

std::string first_upper(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string seconds_text(double seconds) {
  return number_text(
      seconds, seconds < 100 ? NumberForm{.digits = 3, .unit = "s"} : NumberForm{.decimals = 0, .unit = "s"});
}

std::string scene_subject(const Manifest& manifest) {
  std::vector<std::string> columns = manifest.names("column");
  if (columns.empty()) columns = manifest.names("variant");
  return joined({fabric_names(manifest), named_or_counted(manifest.names("law"), "law"),
                 named_or_counted(columns, "column")},
                ", ");
}

std::string about_html(const Manifest& m) {
  std::vector<std::string> facts = {scene_subject(m), named_or_counted(m.names("element"), "element")};
  if (m.triangles) facts.push_back(std::to_string(*m.triangles) + " triangles");
  facts.push_back(m.precision.value_or(""));
  if (m.seconds_simulated) facts.push_back(seconds_text(*m.seconds_simulated) + " simulated");
  if (!m.wall_seconds.empty() && !m.batch) facts.push_back("computed in " + seconds_text(m.total_seconds()));
  facts.push_back(m.device.value_or(""));
  facts.push_back(m.started.substr(0, 10));
  facts.push_back(program_description(m));
  for (std::string& fact : facts) {
    if (!fact.empty()) fact = "<span>" + escaped(fact) + "</span>";  // lines break between facts only
  }
  return "<p class=\"about\">" + joined(facts, " · ") + "</p>\n";
}

}  // namespace hysteron::experiments
