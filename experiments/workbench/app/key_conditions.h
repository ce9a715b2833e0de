// Keys that only some requests read, checked in one place: every subcommand declares the conditions of its
// own keys (Experiment::conditions), and those of scenes and runs stand in key_conditions.cpp.
//
// A condition is written in terms of other keys: "crease.fold = rod | pleat", "integrator != explicit",
// "cloth.copies > 1", "mesh = *.obj" (texts that end so), "fab" (the key is given, or on) and "not fab".
// Terms are combined by " and ", which binds closer, and " or ".  A text that lists several names is equal to
// each of them.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// The experiment's own conditions and, where it simulates, those of scenes and runs for all other keys.
std::vector<KeyCondition> key_conditions(const Experiment& experiment);
// What --help says of the key behind its meaning: "needs --crease.fold rod"; "" where it is always read.
std::string condition_text(const std::vector<KeyCondition>& conditions, const std::string& key);

// The value of each key, by its path.
using KeyValues = std::map<std::string, nlohmann::ordered_json>;
KeyValues key_values(const Keys& keys);

// Throws Error::invalid_input for the first flag of the line whose key is not read: "--crease.radius 0.02 is
// not used: crease.radius needs --crease.fold rod (crease.fold = plate)".  A flag counts as given with its
// default value, too, but not with an empty text or false.  `values` are those of all keys of the experiment,
// its run and its scene.
void refuse_unread_flags(const CommandLine& line, const KeyValues& values);
// Throws Error::invalid_input for a list, "linear,prandtl", that names nothing, whose page would have nothing
// on it, or one name twice, whose rows would stand there twice.
void check_listed_names(const std::string& key, const std::string& list);
// A sentence for each key that is not read and that a scene's file has given another value than its usual
// one; without those that the flags of the line set.
std::vector<std::string> unread_key_warnings(const CommandLine& line, const KeyValues& values,
                                             const KeyValues& usual);

// The flags without those that are not read once a key has another value: what stays of a line where `key` is
// changed for a repetition.
std::vector<Flag> without_unread_flags(const CommandLine& line, const std::string& key,
                                       const std::string& value);

}  // namespace hysteron::experiments
