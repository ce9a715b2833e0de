#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
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

// What stands at a place, if anything does; null is nothing.
struct Rule {
  const char* path;
  const char* kind;
};

const Rule kRules[] = {{"experiment", "a text"},
                       {"command", "a text"},
                       {"started", "a text"},
                       {"complete", "true or false"},
                       {"hysteron.dirty", "true or false"},
                       {"metrics", "an object"},
                       {"wall_seconds", "an object"},
                       {"wall_seconds.total", "a number"},
                       {"seconds_simulated", "a number"},
                       {"frames", "an object"},
                       {"frames.moments", "a list"},
                       {"scene.fabric", "an object"},
                       {"scene.fabric.name", "a text"},
                       {"scene.fabric.provenance", "an object"},
                       {"scene.fabric.published", "an object"}};

// Lists of names may also be one text, "linear,prandtl".
const char* const kNames[] = {"scene.law", "scene.laws", "scene.element", "scene.elements"};

// Entries of which each is an object with these keys.
struct Entries {
  const char* path;
  std::vector<std::string> keys;
};

const Entries kEntries[] = {{"frames.moments", {"s"}},
                            {"scene.fabric.provenance", {"confidence", "source"}},
                            {"scene.fabric.published", {"value", "unit", "confidence", "source"}}};

}  // namespace

void check_manifest(const Json& manifest, const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& path, const std::string& problem) {
    throw Error::invalid_input(file.string() + " is no manifest of hysteron: " + path + " " + problem);
  };
  for (const auto& [path, kind] : kRules)
    if (const Json& value = json_at(manifest, path); !value.is_null() && json_kind(value) != kind)
      refuse(path, "is " + json_kind(value) + ", must be " + kind);
  for (const char* path : kNames)
    if (const Json& names = json_at(manifest, path); names.is_array())
      for (const Json& name : names)
        if (!name.is_string()) refuse(path, "holds " + json_kind(name) + " where a name must be");
  for (const auto& [path, keys] : kEntries)
    for (const Json& entry : json_at(manifest, path))
      for (const std::string& key : keys)
        if (!entry.is_object() || !entry.contains(key)) refuse(path, "has an entry without " + key);
  for (const Json& instant : json_at(manifest, "frames.moments"))
    if (!instant["s"].is_number()) refuse("frames.moments", "has a time s that is no number");
}

}  // namespace hysteron::experiments
