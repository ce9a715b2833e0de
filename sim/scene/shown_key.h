// Tells whether and where a key was set, and shows it in messages.
#pragma once

#include <string>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {

// The entry of a scene's `origin`, with the message, where one source has said its fabric's friction in two
// ways.
inline constexpr const char* kSaidTwice = "friction said twice";

// The beginning of the origin of a key that an experiment has set in place of the user's: "set by buckle:
// ...".
inline constexpr const char* kSetBy = "set by ";

// Has a file, a flag or a program set this key or table, "pin[0]"?  Else it is the program's or the
// experiment's default.
inline bool is_given(const Scene& scene, const std::string& key) { return scene.origin.contains(key); }

// Returns where a key or table was set.
inline std::string key_origin(const Scene& scene, const std::string& key,
                              const std::string& otherwise = "default") {
  return is_given(scene, key) ? scene.origin.at(key) : otherwise;
}

inline bool is_set_by_experiment(const Scene& scene, const std::string& key) {
  return key_origin(scene, key).starts_with(kSetBy);
}

// Shows a key with its value and origin: "fabric.b1 = 1e-6 N m (--fabric.b1)".
inline std::string shown(const Scene& scene, const std::string& key, const std::string& value,
                         const std::string& unit) {
  return key + " = " + with_unit(value, unit) + " (" + key_origin(scene, key) + ")";
}
inline std::string shown(const Scene& scene, const std::string& key, double value, const std::string& unit) {
  return shown(scene, key, number_text(value), unit);
}

// Returns the refusal of a key's number: "fabric.k0 = 0 1/m (--fabric.k0) must be ...".
inline Error refused_value(const Scene& scene, const std::string& key, double value, const std::string& unit,
                           const std::string& what) {
  return Error::invalid_input(shown(scene, key, value, unit) + " " + what).with_key(key, number_text(value));
}

}  // namespace hysteron
