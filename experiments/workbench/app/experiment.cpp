#include "experiments/workbench/app/experiment.h"

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/camera_file.h"
#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/app/scene_source.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/scene/body.h"

namespace hysteron::experiments {

namespace {
std::vector<Experiment> (*catalogue)() = nullptr;
}

Catalogue::Catalogue(std::vector<Experiment> (*all)()) { catalogue = all; }

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = catalogue ? catalogue() : std::vector<Experiment>();
  return all;
}

const Experiment& experiment_named(const std::string& name) {
  static const Experiment kNone{.name = "", .question = ""};
  for (const Experiment& experiment : experiments())
    if (name == experiment.name) return experiment;
  return kNone;
}

std::vector<std::string> Headlines::with_errors() const {
  std::vector<std::string> metrics;
  for (const Headline& headline : all)
    if (headline.has_errors) metrics.push_back(headline.metric);
  return metrics;
}

const Headlines& experiment_headlines(const std::string& experiment) {
  return experiment_named(experiment).headlines;
}

bool is_asked_for(const std::string& metric) {
  for (const Experiment& experiment : experiments())
    for (const Headline& headline : experiment.headlines.all)
      if (metric == headline.metric) return true;
  return false;
}

void check_errors(const std::string& experiment) {
  const auto can_have = [](const Headlines& h) { return h.requested || !h.with_errors().empty(); };
  if (can_have(experiment_headlines(experiment))) return;
  std::vector<std::string> known;
  for (const Experiment& other : experiments())
    if (can_have(other.headlines)) known.emplace_back(other.name);
  throw Error::invalid_input(
      "--errors: " + experiment +
      " has no headline whose errors can be measured; these have: " + join(known, ", "))
      .with_key("errors", "true");
}

std::vector<std::string> CommandLine::words() const {
  std::vector<std::string> words = {experiment};
  words.insert(words.end(), positionals.begin(), positionals.end());
  for (const Flag& flag : flags) words.push_back(flag.word());
  return words;
}

Flag parsed_flag(const std::string& experiment, const std::string& path, const std::string& text) {
  const auto in = [&](const std::vector<KeyDescription>& keys) -> std::optional<Flag> {
    const auto key = std::ranges::find_if(
        keys, [&](const KeyDescription& key) { return key.path == path || key.flag() == path; });
    return key == keys.end() ? std::nullopt : std::optional(Flag{path, parse_text(*key, text)});
  };
  const Experiment& owner = experiment_named(experiment);
  std::optional<Flag> flag;
  if (owner.simulates) flag = in(simulation_keys());
  if (!flag) flag = in(owner.own_keys());
  return flag.value_or(Flag{path, text});
}

std::string last_text(const std::vector<Flag>& flags, const std::string& path, const std::string& otherwise) {
  std::string text = otherwise;
  for (const Flag& flag : flags)
    if (flag.path == path) text = flag.text();
  return text;
}

std::string owners_of_key(const std::string& key) {
  if (has_key(scene_keys(), key)) return "it is an option of what simulates a cloth";
  std::vector<std::string> owners;
  for (const Experiment& experiment : experiments()) {
    if (experiment.hidden || !has_key(experiment.own_keys(), key)) continue;
    if (key.starts_with(std::string(experiment.name) + "."))
      return "it is an option of " + std::string(experiment.name);
    owners.push_back(experiment.name);
  }
  return owners.empty() ? "" : "it is an option of " + join(owners, ", ");
}

namespace {

// Returns the error with the name of the experiment that has its key, if this one does not.
Error with_owner(const Error& error, const Keys& known) {
  if (has_key(scene_keys(), error.key()) || has_key(descriptions(known), error.key())) return error;
  const std::string owner = error.key().empty() ? "" : owners_of_key(error.key());
  return owner.empty() ? error
                       : Error::invalid_input(error.what() + ("; " + owner)).with_key(error.key(), "");
}

// Limits the memory of the process [MB]; 0: no limit.  An allocation beyond it throws std::bad_alloc, which
// ends the run (exit_status.h).
void limit_memory(double megabytes) {
  if (megabytes == 0) return;
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min(static_cast<rlim_t>(1e6 * megabytes), limit.rlim_max);
  ::setrlimit(RLIMIT_DATA, &limit);
}

// Returns the resolved options without those that change no file of a run, or whose outcome is in the scene.
std::shared_ptr<const nlohmann::ordered_json> resolved_options(Keys keys) {
  std::erase_if(keys, [](const BoundKey& key) { return !key.description.traits.is_recorded(); });
  return std::make_shared<const nlohmann::ordered_json>(to_json(keys));
}

// Returns the values of the scene's keys and of further ones.
KeyValues all_values(Scene& scene, const Keys& extra) {
  KeyValues values = key_values(bind_scene(scene));
  values.merge(key_values(extra));
  return values;
}

}  // namespace

Setup set_up(const CommandLine& line, Setup setup, const Keys& own,
             const std::function<void(Setup&)>& quick) {
  decide(line, setup, experiment_named(line.experiment).fixed_keys());
  Keys extra = bind_options(setup.options);
  extra.insert(extra.end(), own.begin(), own.end());
  const KeyValues usual = all_values(setup.scene, extra);
  setup.options.scene = last_text(line.flags, "scene", setup.options.scene);
  try {
    if (!setup.options.scene.empty()) apply_scene(setup, line.experiment, setup.options.scene, extra);
  } catch (const Error& error) {
    throw with_owner(error, extra);
  }
  const std::string camera = last_text(line.flags, "camera", setup.options.camera);
  if (!camera.empty()) read_camera(camera, setup.options);
  apply_flags(setup.scene, line.flags, extra);
  if (!setup.options.scene.empty() && !setup.options.scene.ends_with(".json"))
    setup.unread = unread_key_warnings(line, all_values(setup.scene, extra), usual);
  if (setup.options.quick && quick) {
    quick(setup);  // it may depend on the flags
    // Pictures are as large as on sheets: full ones would take most of a quick run's time.
    setup.options.size =
        std::to_string(setup.options.width() / 2) + "x" + std::to_string(setup.options.height() / 2);
    apply_flags(setup.scene, line.flags, extra);
  }
  make_mesh_paths_absolute(setup.scene);
  check_scene(setup.scene);
  load_bodies(setup.scene);
  check_options(setup.options);
  refuse_unread_flags(line, all_values(setup.scene, extra));
  limit_memory(setup.options.max_memory);
  if (setup.options.errors) check_errors(line.experiment);
  setup.resolved = resolved_options(extra);
  setup.requested = setup.scene;
  if (setup.options.out.empty()) setup.options.out = "out/" + line.experiment;
  return setup;
}

std::vector<KeyDescription> descriptions(const Keys& keys) {
  std::vector<KeyDescription> result;
  for (const BoundKey& key : keys) result.push_back(key.description);
  return result;
}

const std::vector<KeyDescription>& simulation_keys() {
  static const std::vector<KeyDescription> kAll = [] {
    Options options;
    std::vector<KeyDescription> all = descriptions(bind_options(options));
    for (KeyDescription& key : scene_keys()) all.push_back(std::move(key));
    return all;
  }();
  return kAll;
}

const KeyTraits& simulation_traits(const std::string& flag) {
  static const KeyTraits kOwn;
  const auto key = std::ranges::find(simulation_keys(), key_of_flag(flag), &KeyDescription::path);
  return key == simulation_keys().end() ? kOwn : key->traits;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawEntry& law : law_catalogue()) names.push_back(law.name);
  return names;
}

void assign_flag(const Keys& keys, const Flag& flag) {
  assign(find_key(keys, flag.path, flag.name()), flag.value, flag.name());
}

void set_keys(const CommandLine& line, const Keys& keys, const std::function<void()>& quick) {
  const auto apply = [&] {
    for (const Flag& flag : line.flags)
      if (!key_of_flag(flag.path).starts_with("fabric.")) assign_flag(keys, flag);
  };
  apply();
  if (quick && *std::get<bool*>(find_key(keys, "quick", "--quick").field)) {
    quick();
    apply();
  }
  refuse_unread_flags(line, key_values(keys));
}

std::vector<KeyDescription> fabric_keys() {
  std::vector<KeyDescription> keys = scene_keys();
  std::erase_if(keys, [](const KeyDescription& key) { return key.traits.takers != Takers::laws; });
  return keys;
}

Fabric resolved_fabric(const std::string& name_or_file, const std::vector<Flag>& flags) {
  std::vector<Flag> own = {{"fabric", name_or_file}};
  for (const Flag& flag : flags) {
    if (flag.path.starts_with("fabric.")) own.push_back(flag);
  }
  Scene scene;
  apply_flags(scene, own);
  check_scene(scene);
  return scene.fabric;
}

}  // namespace hysteron::experiments
