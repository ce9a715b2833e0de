// A resolved scene as a TOML file that reads back to it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sim/scene/keys.h"

namespace hysteron {

// The file that a fabric of one's own stands in, as its numbers' places name it; else its name.
std::string fabric_to_read(const Scene& scene);

// A key beside those of scenes, of a run or its experiment, and its value as TOML has it.
struct FurtherKey {
  std::string path, value;
};

// The beginning of every resolved scene's file.
inline constexpr const char* kResolvedSceneMark = "# A resolved scene:";

// Every key with its unit and where its value comes from as a comment.  `own`: keys that the experiment has
// set itself.  Tables that it has added are commented out: it will add them again.
std::string scene_toml(const Scene& scene, const std::set<std::string>& own = {},
                       const std::vector<FurtherKey>& others = {});

}  // namespace hysteron
