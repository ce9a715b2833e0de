#include "sim/bending/law_parameters.h"

#include <algorithm>
#include <vector>

#include "sim/error.h"

namespace hysteron {
namespace {

std::string choice(const std::string& law, const std::string& key, const std::string& value,
                   const std::vector<std::string>& allowed) {
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
  std::string list;
  for (const std::string& a : allowed) list += (list.empty() ? "" : ", ") + a;
  throw Error::request("law " + law + ": parameter " + key + " = " + value + " is not one of: " + list);
}

}  // namespace

HysteresisChoice hysteresis_choice(const std::string& name, const LawParameters& parameters) {
  HysteresisChoice result;
  for (const auto& [key, value] : parameters) {
    if (name == "prandtl" && key == "memory") {
      result.stack = choice(name, key, value, {"stops", "stack"}) == "stack";
    } else if (name == "prandtl" && key == "stops") {
      result.stops = std::stoi(choice(name, key, value, {"4", "8", "16", "32"}));
    } else if (name == "prandtl" && key == "stack") {
      result.depth = std::stoi(choice(name, key, value, {"4", "8", "16"}));
    } else if (name == "wong" && key == "recovery") {
      result.reversible = choice(name, key, value, {"masing", "reversible"}) == "reversible";
    } else {
      throw Error::request("law " + name + ": no parameter named " + key);
    }
  }
  return result;
}

}  // namespace hysteron
