// A subcommand of `hysteron`, and what its flags make of scene and options.
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

namespace hysteron::render {
struct Box;
}

namespace hysteron::experiments {

// What the user typed after `hysteron`, taken apart but not yet interpreted.
struct CommandLine {
  std::string experiment;   // "drape"
  std::string command;      // the whole line, quoted for a shell, for the manifest
  std::vector<Flag> flags;  // {"fabric.b2", "1e-5"}, in the order of the keys; bare flags have text "true"
  std::vector<std::string> positionals;  // arguments that are no flags: files, folders
  // Keys that name several of something on the page that this line is set up for: each of its runs has one of
  // them, and checks what depends on it.
  std::vector<std::string> listed = {};
};

// What the last flag of that path says; `otherwise` without one.
std::string last_text(const std::vector<Flag>& flags, const std::string& path, const std::string& otherwise);

struct ChildRun;
struct ComparisonPage;
class Run;
struct Setup;

// A key of scenes that an experiment sets itself, whatever is asked for, or does not use.
struct DecidedKey {
  std::string path;     // "cloth.position"; of an array of tables its name: "pin"
  std::string why;      // "the specimen lies on the pedestal"
  bool unused = false;  // it stays in the scene as it was given, and changes nothing
};

// Keys that are read only while a condition on other keys holds (key_conditions.h): a flag that sets one of
// them without it is refused, and --help shows the condition.
struct KeyCondition {
  const char* keys;   // "crease.radius", several as "fab.gauge | fab.slack", all that begin so as "virgin."
  const char* needs;  // "crease.fold = rod"
  const char* text = "";  // what that is for a reader; "": the condition in terms of flags
};

struct Experiment {
  const char* name;
  const char* question;                      // one line for --help
  int (*run)(const CommandLine&) = nullptr;  // returns the exit code
  bool simulates = false;                    // takes the keys of scenes and Options
  // Further flags.
  std::vector<KeyDescription> (*own_keys)() = [] { return std::vector<KeyDescription>(); };
  Setup (*defaults)() =
      nullptr;  // of an experiment that simulates, for --help; null: they depend on the flags
  // What the pictures of that line frame where its scene decides, for runs beside each other; nothing where
  // it draws none or says so itself.  Null: it is the same for all.
  std::optional<render::Box> (*framing)(const CommandLine&) = nullptr;
  // Of an experiment that simulates: flags of these are refused.
  std::vector<DecidedKey> (*decided)() = [] { return std::vector<DecidedKey>(); };
  const char* positionals = "";  // what CommandLine::names are ("DIR"); "": not allowed
  const char* differs = "";      // what exit code 4 says; "": it does not occur
  bool hidden = false;           // called by scripts of the project: not in --help
  bool compared = false;         // `compare NAME` takes it by its name, other scenes by their files
  // Draws what a comparison of it has beside the plots of all; null: nothing.
  void (*plot_columns)(Run&, const ComparisonPage&, const std::vector<ChildRun>&) = nullptr;
  bool by_chance = false;  // the draw of the mesh decides where its folds lie: a comparison says so
  double onion = 0;        // a comparison shows all instants up to then in one picture first [s]; 0: none
  bool timed = false;      // its results are durations: it shares no process, and no two runs agree
  std::vector<KeyCondition> conditions = {};  // beside those that all simulations have
  Headlines headlines = {};
};

// All subcommands, in the order of --help, as the program has named them.
const std::vector<Experiment>& experiments();
// What names them, once, before main() begins (experiments/catalogue.cpp).
struct Catalogue {
  explicit Catalogue(std::vector<Experiment> (*all)());
};
// The one with this name; one without a name or anything else where there is none.
const Experiment& experiment_named(const std::string& name);

// "it is an option of drape", of a key that no scene has; "" where no experiment has it.
std::string whose(const std::string& key);

// A scene and options, resolved and checked: defaults < scene file < --quick < flags.  `own` are the
// experiment's own keys, bound to its own struct; `quick` is what --quick makes of scene, options and those
// keys.  Throws Error::invalid_input, Error::system.
struct Setup {
  Scene scene;
  Options options;
  // Resolved keys of the run and its experiment that decide what it writes; null: none.
  std::shared_ptr<const nlohmann::ordered_json> resolved = nullptr;
  std::optional<Scene> requested = {};  // before the experiment changes it; nothing: it is not changed
  std::vector<std::string> own_tables =
      {};  // arrays of tables of a scene file that the experiment reads itself
  std::vector<MeshRecord> recorded_meshes = {};  // of the manifest that the scene is from
  std::vector<std::string> requested_metrics =
      {};  // of the scene file: said at the end, and --errors finds theirs, beside the headlines'
  std::vector<DecidedKey> decided = {};  // by the experiment: what a file says of them is not done
  std::vector<std::string> unread = {};  // sentences about keys of the scene's file that nothing reads
};
Setup set_up(const CommandLine& line, Setup defaults, const Keys& own = {},
             const std::function<void(Setup&)>& quick = {});

std::vector<KeyDescription> descriptions(const Keys& keys);
// Whether one of the keys, described or decided, has that path.
template <class Key>
bool has_key(const std::vector<Key>& keys, const std::string& path) {
  return std::ranges::find(keys, path, &Key::path) != keys.end();
}

// "all" is every one; else names separated by commas.  Throws Error::invalid_input for one that is there
// twice.
std::vector<std::string> listed(const std::string& text, const std::vector<std::string>& every);
// Of all laws, in the order of `hysteron list laws`.
std::vector<std::string> law_names();

// For Experiment::own_keys: the keys of a table of rows, or of a function that binds a struct, each with the
// struct's own default; then those that the functions `more` describe.
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

// Sets the key of that path from a flag's text.  Throws what find_key and assign throw.
void assign_text(const Keys& keys, const std::string& path, const std::string& text,
                 const std::string& origin);
// For experiments without a scene.  Sets `keys` from the flags, which win over `quick`: what --quick, one of
// the keys, makes of the struct that they are bound to.  Those of a fabric are left to resolved_fabric().
// Throws Error::invalid_input.
void set_keys(const CommandLine& line, const Keys& keys, const std::function<void()>& quick = {});
// --fabric, --fabric.b1, --fabric.b2, --fabric.k0, --fabric.kes-*, --fabric.stops-*, --fabric.bending.*.
std::vector<KeyDescription> fabric_keys();
// The fabric of that name or file with the flags fabric.* in place of its own numbers, checked like a
// scene's. Throws Error::invalid_input, Error::system.
Fabric resolved_fabric(const std::string& name_or_file, const std::vector<Flag>& flags);

}  // namespace hysteron::experiments
