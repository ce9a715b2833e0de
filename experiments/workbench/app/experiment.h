// A subcommand of `hysteron`, and how its flags become a scene and options.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/app/mesh_record.h"
#include "experiments/workbench/app/options.h"
#include "sim/scene/scene_reader.h"

namespace hysteron {
struct Cloth;
namespace render {
struct Box;
}
}  // namespace hysteron

namespace hysteron::experiments {

// The words after `hysteron`, split but not yet interpreted.
struct CommandLine {
  std::string experiment;                // name of the subcommand: "drape"
  std::string command;                   // the whole line, quoted for a shell, for the manifest
  std::vector<Flag> flags;               // {"fabric.b2", 1e-5}, in the order of the keys; bare flags are true
  std::vector<std::string> positionals;  // arguments that are no flags: files, folders
  // Keys for which this page lists several values: each of its runs has one of them, and checks what depends
  // on it.
  std::vector<std::string> listed = {};

  // Returns the line's words, as another process is given them.
  std::vector<std::string> words() const;
};

// Returns the flag of a text, whose value has the type of the experiment's key; of an unknown key the text
// itself, which is refused where the key is looked for.
Flag parsed_flag(const std::string& experiment, const std::string& path, const std::string& text);
// Returns the text of the last flag of that path; `otherwise` without one.
std::string last_text(const std::vector<Flag>& flags, const std::string& path, const std::string& otherwise);

class Case;
struct ChildRun;
struct ComparisonPage;
class Run;
struct Setup;
struct Variant;
struct VariantPage;

// A key of scenes that an experiment fixes, whatever is requested, or does not use.
struct FixedKey {
  std::string path;     // key, "cloth.position"; for an array of tables its name, "pin"
  std::string why;      // reason: "the specimen lies on the pedestal"
  bool unused = false;  // it stays in the scene as given, without any effect
};

// Keys that are read only while a condition on other keys holds (key_conditions.h): a flag that sets one of
// them without it is refused, and --help shows the condition.
struct KeyCondition {
  const char* keys;       // "crease.radius"; several: "fab.gauge | fab.slack"; a prefix: "virgin."
  const char* needs;      // condition: "crease.fold = rod"
  const char* text = "";  // condition for readers; "": it is expressed by flags
};

struct Experiment {
  const char* name;
  const char* question;  // one line for --help
  // Runs a line that simulates no case, and returns the exit code.  Null if every line has one.
  int (*run)(const CommandLine&) = nullptr;
  // Returns what a line of a simulating experiment simulates (case.h), or null for one without cloth, which
  // is run.  Throws what the experiment refuses.
  std::unique_ptr<Case> (*case_of)(const CommandLine&) = nullptr;
  bool simulates = false;  // true if it takes the keys of scenes and Options
  // Returns the experiment's own keys.
  std::vector<KeyDescription> (*own_keys)() = [] { return std::vector<KeyDescription>(); };
  Setup (*defaults)() = nullptr;  // of a simulating experiment, for --help; null: they depend on the flags
  // Returns the box that the cloth is expected to pass through, for an experiment whose scene may lead it
  // elsewhere: a trial run widens the box for pictures, and runs side by side share it.  Null: the plan has
  // it.
  render::Box (*frame)(const Scene&, const Cloth&) = nullptr;
  // Returns the page of a line that names several laws, fabrics or integrators (session/variant_page.h), from
  // the line without these lists; it may change the variants.  Null: such lines are refused.
  VariantPage (*page)(const CommandLine& first, std::vector<Variant>& variants) = nullptr;
  // Returns the keys that a simulating experiment fixes, whose flags are refused.
  std::vector<FixedKey> (*fixed_keys)() = [] { return std::vector<FixedKey>(); };
  const char* positionals = "";  // meaning of CommandLine::positionals ("DIR"); "": not allowed
  const char* differs = "";      // meaning of exit code 4; "": it does not occur
  bool hidden = false;           // called by scripts of the project, so not in --help
  bool compared = false;         // `compare NAME` takes it by its name, other scenes by their files
  // Draws what a comparison of it has beside the plots of all; null: nothing.
  void (*plot_columns)(Run&, const ComparisonPage&, const std::vector<ChildRun>&) = nullptr;
  bool by_chance = false;  // the draw of the mesh decides where its folds lie: a comparison says so
  double onion = 0;        // a comparison shows all instants up to then in one picture first [s]; 0: none
  bool timed = false;      // its results are durations: it shares no process, and no two runs agree
  std::vector<KeyCondition> conditions = {};  // beside those that all simulations have
  Headlines headlines = {};
};

// Returns all subcommands, in the order of --help.
const std::vector<Experiment>& experiments();
// Registers the subcommands once, before main() begins (experiments/catalogue.cpp).
struct Catalogue {
  explicit Catalogue(std::vector<Experiment> (*all)());
};
// Returns the experiment with this name; an empty one if there is none.
const Experiment& experiment_named(const std::string& name);

// Returns "it is an option of drape" for a key that no scene has; "" if no experiment has it.
std::string owners_of_key(const std::string& key);

// A scene and options, resolved and checked: defaults < scene file < --quick < flags.  `own` are the
// experiment's own keys, bound to its own struct; `quick` applies --quick to scene, options and those keys.
// Throws Error::invalid_input, Error::system.
struct Setup {
  Scene scene;
  Options options;
  // The resolved keys of the run and its experiment that determine what it writes; null: none.
  std::shared_ptr<const nlohmann::ordered_json> resolved = nullptr;
  std::optional<Scene> requested = {};  // the scene before the experiment changes it; empty if it does not
  std::vector<std::string> own_tables =
      {};  // arrays of tables of a scene file that the experiment reads itself
  std::vector<MeshRecord> recorded_meshes = {};  // mesh files of the manifest that the scene is from
  std::vector<std::string> requested_metrics =
      {};  // metrics of the scene file, printed at the end; --errors measures theirs, too
  std::vector<FixedKey> fixed_keys =
      {};                                // keys that the experiment fixes, whose values in a file are ignored
  std::vector<std::string> unread = {};  // warnings of keys of the scene's file that nothing reads
};
Setup set_up(const CommandLine& line, Setup defaults, const Keys& own = {},
             const std::function<void(Setup&)>& quick = {});

std::vector<KeyDescription> descriptions(const Keys& keys);
// Returns the keys that all simulations take, of runs (Options) and of scenes.
const std::vector<KeyDescription>& simulation_keys();
// Returns the traits of that one of them, which a flag may call by its second name; those of an experiment's
// own key for any other.
const KeyTraits& simulation_traits(const std::string& flag);
// True if one of the keys has that path.
template <class Key>
bool has_key(const std::vector<Key>& keys, const std::string& path) {
  return std::ranges::find(keys, path, &Key::path) != keys.end();
}

// Returns all laws, in the order of `hysteron list laws`.
std::vector<std::string> law_names();

// For Experiment::own_keys: return the keys of a table of rows, or of a function that binds a struct, each
// with the struct's own default; then those that the functions `more` describe.
template <class Owner, std::size_t n>
std::vector<KeyDescription> key_descriptions(const KeyRow<Owner> (&rows)[n]) {
  Owner owner;
  return descriptions(bind(rows, owner));
}
template <class Owner>
std::vector<KeyDescription> key_descriptions(Keys (&bound)(Owner&)) {
  Owner owner;
  return descriptions(bound(owner));
}
template <auto& source, auto... more>
std::vector<KeyDescription> own_key_descriptions() {
  std::vector<KeyDescription> keys = key_descriptions(source);
  for (const auto& list : std::initializer_list<std::vector<KeyDescription>>{more()...})
    keys.insert(keys.end(), list.begin(), list.end());
  return keys;
}

// Sets the key that the flag names.  Throws what find_key and assign throw.
void assign_flag(const Keys& keys, const Flag& flag);
// Sets `keys` from the flags, for experiments without a scene; flags override `quick`, which applies --quick,
// one of the keys, to the struct that they are bound to.  Keys of a fabric are left to resolved_fabric().
// Throws Error::invalid_input.
void set_keys(const CommandLine& line, const Keys& keys, const std::function<void()>& quick = {});
// Returns the keys of a fabric that tests of its bending without cloth take: --fabric, --fabric.b2,
// --fabric.bending.* ...
std::vector<KeyDescription> fabric_keys();
// Returns the fabric of that name or file with the flags fabric.* overriding its numbers, checked like a
// scene's.  Throws Error::invalid_input, Error::system.
Fabric resolved_fabric(const std::string& name_or_file, const std::vector<Flag>& flags);

}  // namespace hysteron::experiments
