#include "experiments/workbench/pages/manifest.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_check.h"
#include "experiments/workbench/pages/page.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

// The first key without which a JSON is no manifest; "" if it has all.
std::string missing_in(const Json& json) {
  if (!json.is_object() || !json.contains("hysteron") || !json["hysteron"].is_object())
    return "object hysteron";
  for (const char* key : {"version", "commit"})
    if (!json["hysteron"].contains(key)) return std::string("hysteron.") + key;
  return json.contains("scene") && json["scene"].is_object() ? "" : "object scene";
}

}  // namespace

bool is_manifest(const Json& json) { return missing_in(json).empty(); }

bool has_manifest(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(folder / "manifest.json", ignored));
}

Json read_manifest(const std::filesystem::path& file) {
  Json manifest = read_json(file, "manifest of hysteron");
  if (const std::string missing = missing_in(manifest); !missing.empty())
    throw Error::request(file.string() + " is no manifest of hysteron: it has no " + missing);
  check_manifest(manifest, file);
  return manifest;
}

std::string shown(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "–";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_number_float()) return value.dump();
  std::ostringstream text;
  text.precision(6);
  text << value.get<double>();
  return text.str();
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
  char text[40];
  std::snprintf(text, sizeof text, " %.4g", value);
  return what.name + text + (what.unit.empty() ? "" : " " + what.unit);
}

std::string fabric_name(const Json& manifest) {
  return manifest.at("scene").value("fabric", Json::object()).value("name", "");
}

std::string state_badge(const Json& manifest) {
  const bool complete = manifest.value("complete", false);
  return complete ? "<span class=\"state\">complete</span>" : "<span class=\"state bad\">incomplete</span>";
}

std::string program_of(const Json& manifest) {
  const Json& program = manifest.at("hysteron");
  return "hysteron " + shown(program.at("version")) + ", commit " +
         shown(program.at("commit")).substr(0, 12) + (program.value("dirty", false) ? ", modified" : "");
}

}  // namespace hysteron::experiments
