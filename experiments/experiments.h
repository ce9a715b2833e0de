// The subcommands of `hysteron`.  To add one: declare its function here, list it in experiments.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/options.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {

// What the user typed after `hysteron`, taken apart but not yet interpreted.
struct CommandLine {
  std::string experiment;   // "drape"
  std::string command;      // the whole line, quoted for a shell, for the manifest
  std::vector<Flag> flags;  // {"fabric.b2", "1e-5"}, in the order of the keys; bare flags have text "true"
  std::vector<std::string> names;  // arguments that are no flags: files, folders
};

// What the last flag of that path says; `otherwise` without one.
std::string last_text(const std::vector<Flag>& flags, const std::string& path, const std::string& otherwise);

struct Setup;

struct Experiment {
  const char* name;
  const char* question;                      // one line for --help
  int (*run)(const CommandLine&) = nullptr;  // returns the exit code; null: announced, not built yet
  bool simulates = false;                    // takes the keys of scenes and Options
  std::vector<KeyDescription> (*own_keys)() = nullptr;  // further flags; null: none
  Setup (*defaults)() =
      nullptr;             // of an experiment that simulates, for --help; null: they depend on the flags
  const char* names = "";  // what CommandLine::names are ("DIR"); "": not allowed
};

// All subcommands of the interface, in the order of --help.
const std::vector<Experiment>& experiments();

// A scene and options, resolved and checked: defaults < scene file < --quick < flags.  `own` are the
// experiment's own keys, bound to its own struct; `quick` is what --quick makes of scene, options and those
// keys.  Throws Error::request, Error::machine.
struct Setup {
  Scene scene;
  Options options;
};
Setup set_up(const CommandLine& line, Setup defaults, const Keys& own = {},
             const std::function<void(Setup&)>& quick = {});

// Descriptions of bound keys, for Experiment::own_keys.
std::vector<KeyDescription> descriptions(const Keys& keys);

// For experiments without a scene.  Sets `keys` from the flags, which win over `quick`: what --quick, one of
// the keys, makes of the struct that they are bound to.  Those of a fabric are left to fabric_of().  Throws
// Error::request.
void set_keys(const CommandLine& line, const Keys& keys, const std::function<void()>& quick = {});
// --fabric, --fabric.b1, --fabric.b2, --fabric.k0.
std::vector<KeyDescription> fabric_keys();
// The fabric of that name or file with the flags fabric.* in place of its own numbers, checked like a
// scene's. Throws Error::request, Error::machine.
Fabric fabric_of(const std::string& name_or_file, const std::vector<Flag>& flags);

int drape(const CommandLine& line);
int swing(const CommandLine& line);
int crease(const CommandLine& line);
int fold(const CommandLine& line);
int crumple(const CommandLine& line);
int compare(const CommandLine& line);
int cantilever(const CommandLine& line);
int buckle(const CommandLine& line);
int accuracy(const CommandLine& line);
int bench(const CommandLine& line);
int kes(const CommandLine& line);
int diff(const CommandLine& line);
int figures(const CommandLine& line);
int law(const CommandLine& line);
int fit(const CommandLine& line);
int list(const CommandLine& line);
int render_files(const CommandLine& line);
int report(const CommandLine& line);
int stability(const CommandLine& line);
int validate(const CommandLine& line);

Setup drape_defaults();
Setup swing_defaults();
Setup crease_defaults();
Setup fold_defaults();
Setup crumple_defaults();
Setup cantilever_defaults();
Setup buckle_defaults();
Setup bench_defaults();

std::vector<KeyDescription> crease_keys();
std::vector<KeyDescription> fold_keys();
std::vector<KeyDescription> crumple_keys();
std::vector<KeyDescription> compare_keys();
std::vector<KeyDescription> cantilever_keys();
std::vector<KeyDescription> buckle_keys();
std::vector<KeyDescription> accuracy_keys();
std::vector<KeyDescription> bench_keys();
std::vector<KeyDescription> diff_keys();
std::vector<KeyDescription> drape_keys();
std::vector<KeyDescription> fit_keys();
std::vector<KeyDescription> law_keys();
std::vector<KeyDescription> kes_keys();
std::vector<KeyDescription> figures_keys();
std::vector<KeyDescription> render_keys();
std::vector<KeyDescription> report_keys();
std::vector<KeyDescription> stability_keys();
std::vector<KeyDescription> validate_keys();

}  // namespace hysteron::experiments
