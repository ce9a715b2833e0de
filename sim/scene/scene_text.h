// Writes a resolved scene as a TOML file that reads back to it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sim/scene/keys.h"

namespace hysteron {

// Returns the file of the user's own fabric, as the places of its numbers name it; else the fabric's name.
std::string fabric_to_read(const Scene& scene);

// A key of the run or its experiment, beside those of scenes, and its value in TOML.
struct FurtherKey {
  std::string path, value;
};

// The first line of every resolved scene's file.
inline constexpr const char* kResolvedSceneMark = "# A resolved scene:";

// Writes every key with its unit and, as a comment, where its value comes from.  `own` are keys that the
// experiment has set itself.  Tables that it has added are commented out: it will add them again.
std::string scene_toml(const Scene& scene, const std::set<std::string>& own = {},
                       const std::vector<FurtherKey>& others = {});

}  // namespace hysteron
