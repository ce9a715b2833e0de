#include "experiments/workbench/pages/gallery_about.h"

#include <cstdio>

#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/page.h"
#include "sim/base/comma_list.h"

namespace hysteron::experiments {
namespace {

bool known(const Json& json, const std::string& key) { return json.contains(key) && !json[key].is_null(); }

// "prandtl,linear" or a list of names or of what has one, as the manifests of experiments over several laws
// or fabrics have it.
std::vector<std::string> names_in(const Json& value) {
  if (value.is_string()) return split(value.get<std::string>());
  std::vector<std::string> names;
  for (const Json& entry : value.is_array() ? value : Json::array())
    names.push_back(entry.is_object() ? entry.value("name", "") : entry.get<std::string>());
  return names;
}

// "law prandtl", "laws prandtl, linear", "14 laws"; `one`: the scene's key, or that with an s.
std::string named_or_counted(const Json& scene, const std::string& one) {
  constexpr std::size_t kMostNames = 4;
  const std::vector<std::string> names = names_in(scene.value(scene.contains(one) ? one : one + "s", Json()));
  if (names.empty()) return "";
  if (names.size() > kMostNames) return counted(names.size(), one);
  std::string text = one + (names.size() > 1 ? "s " : " ");
  for (std::size_t i = 0; i < names.size(); ++i) text += (i ? ", " : "") + names[i];
  return text;
}

// The texts that are not empty, between what stands before and after each.
std::string joined(const std::vector<std::string>& texts, const std::string& between) {
  std::string all;
  for (const std::string& text : texts) {
    if (!text.empty()) all += (all.empty() ? "" : between) + text;
  }
  return all;
}

// Of one fabric or several.
std::string fabrics_of(const Json& manifest) {
  const std::string name = fabric_name(manifest);
  if (!name.empty()) return name;
  const std::string several = named_or_counted(manifest.at("scene"), "fabric");
  return several.starts_with("fabric ") ? several.substr(7) : several;
}

}  // namespace

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, seconds < 100 ? "%.3g s" : "%.0f s", seconds);
  return text;
}

std::string subject_of(const Json& manifest) {
  return joined({fabrics_of(manifest), named_or_counted(manifest.at("scene"), "law")}, ", ");
}

std::string about_html(const Json& manifest) {
  std::vector<std::string> facts = {subject_of(manifest), named_or_counted(manifest.at("scene"), "element")};
  if (known(manifest, "triangles")) facts.push_back(shown(manifest["triangles"]) + " triangles");
  if (known(manifest, "precision")) facts.push_back(shown(manifest["precision"]));
  if (known(manifest, "seconds_simulated"))
    facts.push_back(seconds_text(manifest["seconds_simulated"].get<double>()) + " simulated");
  const Json wall = manifest.value("wall_seconds", Json::object());
  if (wall.contains("total")) facts.push_back("computed in " + seconds_text(wall["total"].get<double>()));
  if (known(manifest, "device")) facts.push_back(shown(manifest["device"]));
  facts.push_back(manifest.value("started", "").substr(0, 10));
  facts.push_back(program_of(manifest));
  for (std::string& fact : facts) {
    if (!fact.empty()) fact = "<span>" + escaped(fact) + "</span>";  // broken across lines between facts
  }
  return "<p class=\"about\">" + joined(facts, " · ") + "</p>\n";
}

}  // namespace hysteron::experiments
