// Results carry their unit at the end of their name.
#pragma once

#include <string>

namespace hysteron::experiments {

struct NamedUnit {
  std::string name, unit;
};

// "drape_coefficient_percent" is "drape coefficient" in "%".
NamedUnit split_unit(std::string key);

// "drape coefficient 86 %": four significant digits.
std::string metric_text(const std::string& key, double value);

}  // namespace hysteron::experiments
