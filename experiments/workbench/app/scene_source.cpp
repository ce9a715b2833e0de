#include "experiments/workbench/app/scene_source.h"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run_files.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/scene_text.h"

namespace hysteron::experiments {
namespace {

// Returns what was given: keys and tables that have a place, and the fabric.
Json given_in(const Json& scene, const Json& origin, const std::string& path = "") {
  Json given = Json::object();
  for (const auto& [name, value] : scene.items()) {
    const std::string key = path.empty() ? name : path + "." + name;
    if (key == "fabric" || key == "origin" || origin.contains(key) || origin.contains(key + "[0]"))
      given[name] = value;
    else if (value.is_object())
      given[name] = given_in(value, origin, key);
  }
  return given;
}

// Returns the scene from which this experiment starts.
Json scene_for(const std::string& experiment, const Manifest& manifest) {
  Json scene = *manifest.keys;
  if (manifest.experiment != experiment) return scene;
  if (!manifest.requested) return given_in(scene, scene.value("origin", Json::object()));
  scene.merge_patch(*manifest.requested);
  return scene;
}

// Formats a value as in a TOML file; a table in one line.
std::string toml_value(const Json& value) {
  if (!value.is_structured()) return value.dump();
  std::vector<std::string> entries;
  for (const auto& [name, entry] : value.items())
    entries.push_back((value.is_object() ? name + " = " : "") + toml_value(entry));
  const std::string inner = join(entries, ", ");
  return value.is_object() ? "{" + inner + "}" : "[" + inner + "]";
}

// Collects keys with the paths of all values in a tree of objects; a list is one value.
void collect_leaves(const Json& tree, const std::string& path, std::vector<FurtherKey>& leaves) {
  for (const auto& [name, value] : tree.items()) {
    const std::string key = path.empty() ? name : path + "." + name;
    if (value.is_object())
      collect_leaves(value, key, leaves);
    else
      leaves.push_back({key, toml_value(value)});
  }
}

// Keys of an experiment that a scene's file may have: they are read and dropped.
class DroppedKeys {
 public:
  explicit DroppedKeys(const std::vector<KeyDescription>& descriptions) {
    for (const KeyDescription& key : descriptions) keys_.push_back({key, scratch_.field(key.type)});
  }
  const Keys& keys() const { return keys_; }

 private:
  Scratch scratch_;
  Keys keys_;
};

}  // namespace

void apply_scene(Setup& setup, const std::string& experiment, const std::string& name, const Keys& extra) {
  if (!name.ends_with(".json")) return apply_scene_file(setup.scene, name, extra, setup.own_tables);
  const Manifest manifest = read_manifest(name);
  if (!manifest.keys->contains("cloth"))
    throw Error::invalid_input(
        name + " is of `" + manifest.experiment +
        "` and holds no scene that was simulated: name the manifest of one of its runs (--scene)")
        .with_key("scene", name);
  Json tree = scene_for(experiment, manifest);
  if (manifest.experiment == experiment && manifest.options) tree.merge_patch(*manifest.options);
  apply_recorded_scene(setup.scene, std::move(tree), name, extra, setup.own_tables);
  find_meshes(setup.scene, manifest.meshes, name);
  setup.recorded_meshes = manifest.meshes;
}

Setup setup_of_file(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  Setup setup = experiment.defaults ? experiment.defaults() : Setup{default_scene(), {}};
  setup.own_tables = {"metric"};
  const std::string file = last_text(line.flags, "scene", setup.options.scene);
  if (file.empty()) return setup;
  const DroppedKeys own(experiment.own_keys());
  Keys extra = bind_options(setup.options);
  extra.insert(extra.end(), own.keys().begin(), own.keys().end());
  apply_scene(setup, line.experiment, file, extra);
  return setup;
}

Json requested_patch(const Json& simulated, const Json& requested) {
  Json patch = Json::object();
  for (const auto& [name, value] : requested.items()) {
    const bool known = simulated.contains(name);
    if (known && simulated[name] == value) continue;
    patch[name] = known && simulated[name].is_object() && value.is_object()
                      ? requested_patch(simulated[name], value)
                      : value;
  }
  for (const auto& [name, value] : simulated.items())
    if (!requested.contains(name)) patch[name] = nullptr;
  return patch;
}

void refuse_two_scenes(const CommandLine& line) {
  const std::string other = last_text(line.flags, "scene", "");
  if (!line.positionals.empty() && !other.empty())
    throw Error::invalid_input("takes one scene, and both " + line.positionals.front() + " and --scene " +
                               other + " name one")
        .with_key("scene", other);
}

bool is_dumped_scene(const std::string& file) { return has_mark(file, kResolvedSceneMark); }

// Writes the request, since the experiment will change it once more; but the time and the steps that it has
// set, which it sets only if they are not given, and all pins and obstacles.
void dump_scene(const Setup& setup) {
  require_own_file(setup.options.dump_scene, kResolvedSceneMark, "a resolved scene", "dump-scene");
  Scene scene = *setup.requested;
  std::set<std::string> own;
  const auto keep = [&](const char* key, auto Scene::*member) {
    if (scene.*member != setup.scene.*member) own.insert(key);
    scene.*member = setup.scene.*member;
  };
  keep("seconds", &Scene::seconds);
  keep("step", &Scene::step);
  keep("integrator", &Scene::integrator);
  keep("tolerance", &Scene::tolerance);
  keep("newton-residual", &Scene::newton_residual);
  scene.pin = setup.scene.pin;
  scene.obstacle = setup.scene.obstacle;
  std::vector<FurtherKey> others;
  collect_leaves(*setup.resolved, "", others);
  write_text(setup.options.dump_scene, scene_toml(scene, own, others));
}

}  // namespace hysteron::experiments
