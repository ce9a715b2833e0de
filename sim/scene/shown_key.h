// A key in a message: its value and where it was set.
#pragma once

#include <string>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Where a key was set; the program's defaults and the experiment's have no place.
inline std::string key_origin(const Scene& scene, const std::string& key) {
  const auto found = scene.origin.find(key);
  return found == scene.origin.end() ? "default" : found->second;
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
