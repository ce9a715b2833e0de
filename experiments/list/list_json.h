// `list --json`: what there is, for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

// A number of a fabric, as its file states it.
struct StatedNumber {
  std::string name, unit;
  std::vector<double> value;  // one, or those of a list
  bool is_list = false;
  const Provenance* from = nullptr;
  const Range* range = nullptr;  // null: none is stated
};
// In the order of the keys; they refer to the file's.
std::vector<StatedNumber> stated_numbers(const FabricFile& file);

// Name, description, every number with value, unit, how it is known, its range where one is stated and its
// source, and the numbers as published.
nlohmann::ordered_json fabric_json(const FabricFile& file);
// The lists of that name: fabrics, laws, scenes or devices.
nlohmann::ordered_json json_list(const std::string& name);

}  // namespace hysteron::experiments
