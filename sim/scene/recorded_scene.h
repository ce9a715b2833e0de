// A scene back from what to_json(scene) (keys.h) has written into a manifest.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Sets every key that `tree` holds; others stay as they are.  No file is asked for the fabric: its numbers,
// their sources and what is published of it are those of `tree`, and so is where each key was set.  `file`
// names it in messages; `extra` and `left` as in apply_scene_file (scene_reader.h).  Throws
// Error::invalid_input for keys that are not known, wrong types and values out of range.
void apply_recorded_scene(Scene& scene, nlohmann::ordered_json tree, const std::string& file,
                          const Keys& extra = {}, const std::vector<std::string>& left = {});

}  // namespace hysteron
