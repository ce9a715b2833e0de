// Reads scenes from defaults, a TOML file and flags; later ones override earlier ones.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/keys.h"
#include "sim/scene/scene.h"

namespace hysteron {

struct ValueTree;

// A flag and its value: "--fabric.b2 1e-5" is {"fabric.b2", 1e-5}; "--param stops=16" is {"param",
// "stops=16"}.  Where a command line, a study or a record has a text, it is parsed once, as its key's type
// says (parsed_flag() of experiments/workbench/app/experiment.h).
struct Flag {
  std::string path;
  Value value;

  std::string text() const { return value_text(value); }
  std::string name() const { return "--" + path; }
  std::string word() const { return name() + "=" + text(); }  // as another process is given it
  // Returns it as messages name it: "--fabric.b2 1e-05"; a switch that is on by its name alone.
  std::string shown() const { return name() + (value == Value(true) ? "" : " " + text()); }
  bool operator==(const Flag&) const = default;
};

// Returns a scene with the program's defaults and a fabric of assets/fabrics.
Scene default_scene(const std::string& fabric = "cotton-broad");

// Applies a scene file.  Naming a fabric starts it afresh, single fabric.* keys then override its numbers,
// whatever their order in the file. [[pin]] and [[obstacle]] replace those of the defaults, if there are any
// in the file.  Keys in `extra` (an experiment's own, or the run's options) are allowed at the top level too.
// Arrays of tables whose names are in `left` are left to the caller.  A cloth, mesh or body file is looked
// for from the working folder, then beside the scene file.  Throws Error::invalid_input (one line with file,
// line, key, value, unit, range), Error::system if unreadable.
void apply_scene_file(Scene& scene, const std::string& name_or_file, const Keys& extra = {},
                      const std::vector<std::string>& left = {});
// Applies the same from a tree that another program has made; `source` stands for the file in messages.  If
// the tree is a run's record (`recorded`) it is taken as it stands: no fabric file is read, and no file is
// looked for beside the source.
void apply_scene_tree(Scene& scene, const ValueTree& root, const std::string& source, const Keys& extra = {},
                      const std::vector<std::string>& left = {}, bool recorded = false);

// Restores a scene from what to_json(scene) (keys.h) has written into a manifest: sets every key that `tree`
// holds; others stay as they are.  No fabric file is read: the fabric's numbers, their sources and published
// numbers, and where each key was set, are those of `tree`.  `file` names it in messages; `extra` and `left`
// are as in apply_scene_file.  Throws Error::invalid_input for keys that are not known, wrong types and
// values out of range.
void apply_recorded_scene(Scene& scene, nlohmann::ordered_json tree, const std::string& file,
                          const Keys& extra = {}, const std::vector<std::string>& left = {});

// Applies flags, a fabric first; `extra` is as above.
void apply_flags(Scene& scene, const std::vector<Flag>& flags, const Keys& extra = {});

// Checks what no single key can tell: b1 >= b2, k0 > 0 or b1 = b2, coupling^2 < warp*weft, `chapter` on
// hinges only, pins, obstacles and their motions, the law's parameters, the mesh's name.  Throws
// Error::invalid_input.
void check_scene(const Scene& scene);
// Checks whether the lists of fabric.bending.* and fabric.membrane.* fit together; a part of check_scene().
void check_fabric_lists(const Scene& scene);
// Checks that a scene that is about to run has at least one step, and that commands are due before its end
// (experiments choose how long they last).  Throws Error::invalid_input.
void check_duration(const Scene& scene);
void check_steps(const Scene& scene);  // a part of check_scene(): what the integrator can do

// Times that are given by the names of phases.

// Returns when the named phase first begins [s]; -1 if there is none of that name.
double phase_start(const std::vector<Phase>& phases, const std::string& name);
// Returns a time [s] written as "hang", "hang + 0.2" or "hang - 0.2", with or without spaces.  Throws
// Error::invalid_input, which ends in `origin`, for an unknown phase or a malformed number.
double phase_time(const std::vector<Phase>& phases, const std::string& text, const std::string& origin);

}  // namespace hysteron
