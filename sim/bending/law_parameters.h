// Parameters of a law by name, as scene files and flags give them, read with their defaults.
#pragma once

#include <map>
#include <set>
#include <string>

namespace hysteron {

using LawParameters = std::map<std::string, std::string>;

// What a simulated `prandtl` or `wong` is asked for.
struct HysteresisChoice {
  bool stack = false;       // memory = stops | stack
  int stops = 8;            // 4 | 8 | 16 | 32
  int depth = 8;            // stack: 4 | 8 | 16 reversal points
  bool reversible = false;  // recovery = masing | reversible (wong)
};

// Error::request for a parameter that law `name` does not have or a value outside its choices.
HysteresisChoice hysteresis_choice(const std::string& name, const LawParameters& parameters);

}  // namespace hysteron
