// The keys of a Scene: one table for scene files, flags, messages, range checks and the manifest.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Describes every key that a flag or the top level and plain tables of a scene file may set, in the
// manifest's order.
std::vector<KeyDescription> scene_keys();

// Bind the same keys, and those of [[pin]], [[obstacle]], their keyframes and [[command]], to one object.
Keys bind_scene(Scene& scene);
Keys bind_pin(Pin& pin);
Keys bind_obstacle(Obstacle& obstacle);
Keys bind_command(SceneEvent& command);
Keys bind_phase(Phase& phase);
Keys bind_keyframe(Keyframe& keyframe);

// A key may have a second name, by which flags, studies and tables call it: --fabric sets fabric.name, and
// files take both.  key_of_flag("fabric") is "fabric.name", flag_of_key("fabric.name") is "fabric"; they
// return every other name as it is.
std::string key_of_flag(const std::string& flag);
std::string flag_of_key(const std::string& path);

// Sets one key from a flag's text and remembers `origin` ("--step").  "fabric" and "fabric.name" load a whole
// fabric (all its earlier values are replaced); another fabric.* key replaces one number, whose provenance
// becomes `origin`, "given".  Throws Error::invalid_input as assign_text and find_key do.
void set_key(Scene& scene, const std::string& path, const std::string& text, const std::string& origin);
// Sets one key from a file's value; `key` is one of bind_scene(scene).
void set_key(Scene& scene, const BoundKey& key, const Value& value, const std::string& origin);

// Returns the resolved scene: every key in SI units, the fabric's sources, and where each key was set.
// Shipped meshes are named assets/..., as asset_name() does.
nlohmann::ordered_json to_json(const Scene& scene);

}  // namespace hysteron
