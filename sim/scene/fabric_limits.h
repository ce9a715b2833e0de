// The numbers that a fabric can have: one table of what is possible and what is usual, consulted wherever a
// fabric enters (flags, scenes, fabric files, what `fit` is given and finds, Python, axes of sweeps).
//
// Impossible numbers are refused; unusual ones run, since studies ask for extremes, and are warned of.  A
// number that would be usual in another unit is warned of with that unit: "124 kg/m^2: g/m^2 given? Then it
// is 0.124 kg/m^2".
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/scene/scene_reader.h"

namespace hysteron {

// Throws Error::invalid_input, which names `key` and `origin`, where the parameter ("density") cannot have
// that value; names that the table lacks are not checked.
void check_fabric_number(const std::string& parameter, double value, const std::string& key,
                         const std::string& origin);
// Warns of an unusual value; "" where it is usual.
std::string fabric_number_warning(const std::string& parameter, double value, const std::string& key,
                                  const std::string& origin);

// Do the same for all numbers of the scene's fabric.
void check_fabric_numbers(const Scene& scene);
std::vector<std::string> fabric_warnings(const Scene& scene);
// Does both for a fabric's name or file, with flags fabric.* in place of its own numbers, for callers that
// have no scene.
std::vector<std::string> checked_fabric_warnings(const std::string& name_or_file,
                                                 const std::vector<Flag>& flags = {});

}  // namespace hysteron
