// What was given, and a key in a message: its value and where it was set.
#pragma once

#include <string>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Stands in a scene's `origin` where one source has said its fabric's friction in two ways, with the message.
inline constexpr const char* kSaidTwice = "friction said twice";

// Begins the origin of a key that an experiment has set in place of what was given: "set by buckle: ...".
inline constexpr const char* kSetBy = "set by ";

// Whether a file, a flag or a program has set this key or table, "pin[0]"; else it is as the program or the
// experiment has it by itself.
inline bool is_given(const Scene& scene, const std::string& key) { return scene.origin.contains(key); }

// Where a key or table was given.
inline std::string key_origin(const Scene& scene, const std::string& key,
                              const std::string& otherwise = "default") {
  return is_given(scene, key) ? scene.origin.at(key) : otherwise;
}

inline bool is_set_by_experiment(const Scene& scene, const std::string& key) {
  return key_origin(scene, key).starts_with(kSetBy);
}

// "fabric.b1 = 1e-6 N m (--fabric.b1)"
inline std::string shown(const Scene& scene, const std::string& key, const std::string& value,
                         const std::string& unit) {
  return key + " = " + value + (unit.empty() ? "" : " " + unit) + " (" + key_origin(scene, key) + ")";
}
inline std::string shown(const Scene& scene, const std::string& key, double value, const std::string& unit) {
  return shown(scene, key, number_text(value), unit);
}

}  // namespace hysteron
