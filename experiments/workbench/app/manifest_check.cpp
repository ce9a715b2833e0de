#include "experiments/workbench/app/manifest_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

std::string json_kind(const Json& value) {
  if (value.is_null()) return "null";
  if (value.is_boolean()) return "true or false";
  if (value.is_number()) return "a number";
  if (value.is_string()) return "a text";
  return value.is_array() ? "a list" : "an object";
}

// What stands at a place, if anything does.
struct Rule {
  const char* path;
  std::vector<std::string> kinds;
};

const Rule kRules[] = {{"/experiment", {"a text"}},
                       {"/command", {"a text"}},
                       {"/started", {"a text"}},
                       {"/complete", {"true or false"}},
                       {"/hysteron/dirty", {"true or false"}},
                       {"/metrics", {"an object"}},
                       {"/wall_seconds", {"an object"}},
                       {"/wall_seconds/total", {"a number"}},
                       {"/seconds_simulated", {"a number", "null"}},
                       {"/frames", {"an object"}},
                       {"/frames/moments", {"a list"}},
                       {"/scene/fabric", {"an object"}},
                       {"/scene/fabric/name", {"a text"}},
                       {"/scene/fabric/provenance", {"an object"}},
                       {"/scene/fabric/published", {"an object"}}};

// Lists of names may also be one text, "linear,prandtl".
const char* const kNames[] = {"/scene/law", "/scene/laws", "/scene/element", "/scene/elements"};

// Entries of which each is an object with these keys.
struct Entries {
  const char* path;
  std::vector<std::string> keys;
};

const Entries kEntries[] = {{"/frames/moments", {"s"}},
                            {"/scene/fabric/provenance", {"confidence", "source"}},
                            {"/scene/fabric/published", {"value", "unit", "confidence", "source"}}};

Error bad(const std::filesystem::path& file, const char* path, const std::string& problem) {
  std::string key = path + 1;
  std::replace(key.begin(), key.end(), '/', '.');
  return Error::invalid_input(file.string() + " is no manifest of hysteron: " + key + " " + problem);
}

// Null if there is nothing.
const Json* find(const Json& manifest, const char* path) {
  const Json::json_pointer place(path);
  return manifest.contains(place) ? &manifest.at(place) : nullptr;
}

void check_names(const Json& names, const char* path, const std::filesystem::path& file) {
  for (const Json& name : names.is_array() ? names : Json::array())
    if (!name.is_string()) throw bad(file, path, "holds " + json_kind(name) + " where a name must be");
}

void check_entries(const Json& entries, const Entries& wanted, const std::filesystem::path& file) {
  for (const Json& entry : entries)
    for (const std::string& key : wanted.keys)
      if (!entry.is_object() || !entry.contains(key))
        throw bad(file, wanted.path, "has an entry without " + key);
}

}  // namespace

void check_manifest(const Json& manifest, const std::filesystem::path& file) {
  for (const Rule& rule : kRules) {
    const Json* value = find(manifest, rule.path);
    if (value && !std::count(rule.kinds.begin(), rule.kinds.end(), json_kind(*value)))
      throw bad(file, rule.path, "is " + json_kind(*value) + ", must be " + rule.kinds[0]);
  }
  for (const char* path : kNames)
    if (const Json* names = find(manifest, path)) check_names(*names, path, file);
  for (const Entries& wanted : kEntries)
    if (const Json* entries = find(manifest, wanted.path)) check_entries(*entries, wanted, file);
  if (const Json* instants = find(manifest, "/frames/moments"))
    for (const Json& instant : *instants)
      if (!instant["s"].is_number()) throw bad(file, "/frames/moments", "has a time s that is no number");
}

}  // namespace hysteron::experiments
