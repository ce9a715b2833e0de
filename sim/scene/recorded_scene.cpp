// Restores a scene from a run's record.
#include <nlohmann/json.hpp>

#include "sim/base/error.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/value_tree.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

Error malformed(const std::string& path, const std::string& what, const std::string& file) {
  return Error::invalid_input("scene." + path + " " + what + " (" + file + ")").with_key(path, "");
}

std::string string_at(const Json& json, const std::string& path, const std::string& file) {
  if (!json.is_string()) throw malformed(path, "must be a text", file);
  return json.get<std::string>();
}

std::map<std::string, std::string> texts(const Json& entries, const std::string& path,
                                         const std::string& file) {
  if (!entries.is_object()) throw malformed(path, "must be an object", file);
  std::map<std::string, std::string> all;
  for (const auto& [name, text] : entries.items()) all[name] = string_at(text, path + "." + name, file);
  return all;
}

Provenance provenance(const Json& entry, const std::string& path, const std::string& file) {
  if (!entry.is_object() || !entry.contains("source") || !entry.contains("confidence"))
    throw malformed(path, "must have source and confidence", file);
  return {string_at(entry["source"], path + ".source", file),
          string_at(entry["confidence"], path + ".confidence", file)};
}

void read_provenance(const Json& entries, const std::string& file, Fabric& fabric) {
  fabric.provenance.clear();
  for (const auto& [name, entry] : entries.items())
    fabric.provenance[name] = provenance(entry, "fabric.provenance." + name, file);
}

void read_published(const Json& entries, const std::string& file, Fabric& fabric) {
  fabric.published.clear();
  for (const auto& [name, entry] : entries.items()) {
    const std::string path = "fabric.published." + name;
    const Provenance from = provenance(entry, path, file);
    if (!entry.contains("value") || !entry["value"].is_number() || !entry.contains("unit"))
      throw malformed(path, "must have a value and its unit", file);
    fabric.published[name] = {
        entry["value"].get<double>(), string_at(entry["unit"], path + ".unit", file), from,
        entry.contains("tester")
            ? value_if_named<DrapeStandard>(string_at(entry["tester"], path + ".tester", file))
            : std::nullopt};
  }
}

// Takes the entry of that name out of the object; null if there is none.
Json taken(Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) return nullptr;
  const Json entry = object[name];
  object.erase(name);
  return entry;
}

}  // namespace

void apply_recorded_scene(Scene& scene, Json tree, const std::string& file, const Keys& extra,
                          const std::vector<std::string>& left) {
  scene.fabric.kes = {};  // older manifests lack it
  if (tree.contains("param")) scene.param.clear();
  const Json origin = taken(tree, "origin");
  if (tree.contains("fabric")) {
    if (const Json from = taken(tree["fabric"], "provenance"); !from.is_null())
      read_provenance(from, file, scene.fabric);
    if (const Json printed = taken(tree["fabric"], "published"); !printed.is_null())
      read_published(printed, file, scene.fabric);
  }
  apply_scene_tree(scene, json_tree(tree, file), file, extra, left, true);
  if (!origin.is_null()) scene.origin = texts(origin, "origin", file);
}

}  // namespace hysteron
