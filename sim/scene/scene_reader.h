// Scenes from defaults, a TOML file and flags, in this order of precedence.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/keys.h"
#include "sim/scene/scene.h"

namespace hysteron {

struct ValueTree;

// "--fabric.b2 1e-5" is {"fabric.b2", "1e-5"}; "--param stops=16" is {"param", "stops=16"}.
struct Flag {
  std::string path;
  std::string text;
  bool operator==(const Flag&) const = default;
};

// A scene with the program's defaults and a fabric of assets/fabrics.
Scene default_scene(const std::string& fabric = "cotton-broad");

// Applies a scene file.  Naming a fabric starts it afresh, single fabric.* keys then override its numbers,
// whatever their order in the file.  [[pin]] and [[obstacle]] replace those of the defaults, if there are any
// in the file.  Keys in `extra` (an experiment's own, or the run's options) are allowed at the top level too.
// Arrays of tables called as in `left` are left to the caller.
// A cloth, mesh or body file is looked for from the working folder, then beside the scene file.
// Throws Error::invalid_input (one line with file, line, key, value, unit, range), Error::system if
// unreadable.
void apply_scene_file(Scene& scene, const std::string& name_or_file, const Keys& extra = {},
                      const std::vector<std::string>& left = {});
// The same from a tree that another program has made; `source` stands for the file in messages.  What a run
// has recorded is taken as it stands: no file is asked for the fabric, none is looked for beside the source.
void apply_scene_tree(Scene& scene, const ValueTree& root, const std::string& source, const Keys& extra = {},
                      const std::vector<std::string>& left = {}, bool recorded = false);

// A scene back from what to_json(scene) (keys.h) has written into a manifest.
// Sets every key that `tree` holds; others stay as they are.  No file is asked for the fabric: its numbers,
// their sources and what is published of it are those of `tree`, and so is where each key was set.  `file`
// names it in messages; `extra` and `left` as in apply_scene_file.  Throws
// Error::invalid_input for keys that are not known, wrong types and values out of range.
void apply_recorded_scene(Scene& scene, nlohmann::ordered_json tree, const std::string& file,
                          const Keys& extra = {}, const std::vector<std::string>& left = {});

// Applies flags; a fabric is loaded first.  `extra` as above.
void apply_flags(Scene& scene, const std::vector<Flag>& flags, const Keys& extra = {});

// What no single key can tell: b1 >= b2, k0 > 0 or b1 = b2, coupling^2 < warp*weft, `chapter` on hinges only,
// pins, obstacles and their motions, the law's parameters, the mesh's name.  Throws Error::invalid_input.
void check_scene(const Scene& scene);
// The part of it that asks whether the lists of fabric.bending.* and fabric.membrane.* fit together.
void check_fabric_lists(const Scene& scene);
// That there is a step in it at all, and that commands are due before its end: of a scene that is about to
// run, since experiments say how long they last.  Throws Error::invalid_input.
void check_duration(const Scene& scene);
void check_steps(const Scene& scene);  // the part of it that asks what the integrator can do

// Times of a scene by the names of its phases.

// When the named phase begins, in its first cycle where there are several [s]; -1 if there is none of that
// name.
double phase_start(const std::vector<Phase>& phases, const std::string& name);
// A time written as "hang", "hang + 0.2" or "hang - 0.2" (spaces as one likes) [s].  Error::invalid_input,
// which ends in `origin`, for a name that is no phase or a number that is none.
double phase_time(const std::vector<Phase>& phases, const std::string& text, const std::string& origin);

}  // namespace hysteron
