#include "experiments/workbench/pages/gallery_about.h"

#include <fmt/core.h>

#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/page.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

// "law prandtl", "laws prandtl, linear", "14 laws".
std::string named_or_counted(const std::vector<std::string>& names, const std::string& one) {
  constexpr std::size_t kMaxNames = 4;
  if (names.empty()) return "";
  if (names.size() > kMaxNames) return counted(names.size(), one);
  return one + (names.size() > 1 ? "s " : " ") + join(names, ", ");
}

// Of one fabric or several.
std::string fabric_names(const Manifest& manifest) {
  if (const std::string name = manifest.text("fabric.name"); !name.empty()) return name;
  const std::string several = named_or_counted(manifest.names("fabric"), "fabric");
  return several.starts_with("fabric ") ? several.substr(7) : several;
}

}  // namespace

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

std::string grouped(long count) {
  std::string text = std::to_string(count);
  for (int at = static_cast<int>(text.size()) - 3; at > (count < 0); at -= 3) text.insert(at, 1, ',');
  return text;
}

std::string seconds_text(double seconds) {
  return seconds < 100 ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.0f} s", seconds);
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
    if (!fact.empty()) fact = "<span>" + escaped(fact) + "</span>";  // broken across lines between facts
  }
  return "<p class=\"about\">" + joined(facts, " · ") + "</p>\n";
}

}  // namespace hysteron::experiments
