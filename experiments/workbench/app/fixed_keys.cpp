#include "experiments/workbench/app/fixed_keys.h"

#include <nlohmann/json.hpp>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/scene_source.h"
#include "sim/base/error.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {

std::vector<FixedKey> unused_but(const std::string& beginning, const std::set<std::string>& used,
                                 const std::string& why) {
  std::vector<FixedKey> keys;
  for (const KeyDescription& key : scene_keys())
    if (key.path.starts_with(beginning) && !used.contains(key.path)) keys.push_back({key.path, why, true});
  return keys;
}

std::string fixed_key_message(const std::string& experiment, const FixedKey& key) {
  return experiment + (key.unused ? " does not use " : " sets ") + key.path + (key.unused ? "" : " itself") +
         ": " + key.why;
}

void throw_if_flags(const CommandLine& line, const std::vector<FixedKey>& fixed_keys) {
  for (const Flag& flag : line.flags)
    for (const FixedKey& key : fixed_keys)
      if (key_of_flag(flag.path) == key.path)
        throw Error::invalid_input(flag.shown() + ": " + fixed_key_message(line.experiment, key))
            .with_key(key.path, flag.text());
}

void decide(const CommandLine& line, Setup& setup, const std::vector<FixedKey>& keys) {
  throw_if_flags(line, keys);
  setup.fixed_keys.insert(setup.fixed_keys.end(), keys.begin(), keys.end());
}

void note_setter(Scene& scene, const std::string& experiment, const FixedKey& key) {
  scene.origin[key.path] = kSetBy + experiment + ": " + key.why;
}

namespace {

// True if the number comes from the fabric's own file and neither flag nor scene: naming a fabric requests
// only those of its numbers that are used.
bool is_of_fabric_file(const Scene& scene, const std::string& path) {
  const std::string prefix = "fabric.";
  if (!path.starts_with(prefix)) return false;
  const auto found = scene.fabric.provenance.find(path.substr(prefix.size()));
  return found != scene.fabric.provenance.end() && found->second.source != key_origin(scene, path);
}

}  // namespace

// A dumped file has every key; those that equal the experiment's defaults request nothing.
std::vector<std::string> ignored_key_warnings(const CommandLine& line, const Setup& setup) {
  std::vector<std::string> words;
  const auto defaults = experiment_named(line.experiment).defaults;
  if (!defaults || setup.fixed_keys.empty()) return words;
  const Json default_values = to_json(defaults().scene), requested = to_json(*setup.requested),
             now = to_json(setup.scene);
  for (const FixedKey& key : setup.fixed_keys) {
    if (const std::string place = key_origin(setup.scene, key.path + "[0]", ""); !place.empty())
      words.push_back("[[" + key.path + "]] (" + place +
                      ") is not used: " + fixed_key_message(line.experiment, key));
    if (!is_given(*setup.requested, key.path) || is_of_fabric_file(*setup.requested, key.path)) continue;
    const Json& value = json_at(requested, key.path);
    if (value == json_at(default_values, key.path) || (!key.unused && value == json_at(now, key.path)))
      continue;
    words.push_back(key.path + " = " + value.dump() + " (" + key_origin(*setup.requested, key.path) +
                    ") is not used: " + fixed_key_message(line.experiment, key));
  }
  return words;
}

std::vector<std::string> late_table_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  const auto add = [&](const auto& tables, const std::string& list) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const std::string path = list + "[" + std::to_string(i) + "]";
      if (!is_given(scene, path) || tables[i].from < scene.seconds) continue;
      warnings.push_back(path + ".from = " + number_text(tables[i].from) + " s (" +
                         key_origin(scene, path + ".from", key_origin(scene, path)) +
                         ") is not used: the scene is over at " +
                         shown(scene, "seconds", scene.seconds, "s"));
    }
  };
  if (scene.seconds > 0) {
    add(scene.pin, "pin");
    add(scene.obstacle, "obstacle");
  }
  return warnings;
}

void refuse_late_tables(const Setup& setup) {
  const std::vector<std::string> late = late_table_warnings(setup.scene);
  const std::string place = key_origin(setup.scene, "seconds");  // the place: "scene.toml:3"
  if (late.empty() || setup.options.quick || place == "--seconds") return;
  if (is_dumped_scene(place.substr(0, place.rfind(':')))) return;  // its end may be from a flag of that run
  throw Error::invalid_input(late.front()).with_key("from", "");
}

}  // namespace hysteron::experiments
