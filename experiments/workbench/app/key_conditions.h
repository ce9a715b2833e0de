// Checks in one place which keys a request reads: every subcommand declares the conditions of its own keys
// (Experiment::conditions), and the rows of scenes' and runs' keys state theirs (KeyTraits::needs).  Options
// for the look of pictures have none: the manifest keeps them, and scripts draw pictures or leave them out by
// one flag.  The renderer has one.
//
// A condition is written in terms of other keys: "crease.fold = rod | pleat", "integrator != explicit",
// "cloth.copies > 1", "mesh = *.obj" (texts with that end), "fab" (the key is given, or on) and "not fab".
// Terms are combined by " and ", which binds closer, and " or ".  A text that lists several names is equal to
// each of them.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Returns the experiment's own conditions and, if it simulates, those of scenes and runs for all other keys.
std::vector<KeyCondition> key_conditions(const Experiment& experiment);
// Returns what --help adds to the key's meaning: "needs --crease.fold rod"; "" if it is always read.
std::string condition_text(const std::vector<KeyCondition>& conditions, const std::string& key);

// The value of each key, by its path.
using KeyValues = std::map<std::string, nlohmann::ordered_json>;
KeyValues key_values(const Keys& keys);

// Throws Error::invalid_input for the first flag of the line whose key is not read: "--crease.radius 0.02 is
// not used: crease.radius needs --crease.fold rod (crease.fold = plate)".  A flag counts as given with its
// default value, too, but not with an empty text or false.  `values` are those of all keys of the experiment,
// its run and its scene.
void refuse_unread_flags(const CommandLine& line, const KeyValues& values);
// Returns the names of a key's list, "linear,prandtl"; where there are `every`, "all" alone stands for these.
// Throws Error::invalid_input for a list that is empty or has a name twice, because its page would be empty
// or repeat rows.
std::vector<std::string> listed_names(const std::string& key, const std::string& list,
                                      const std::vector<std::string>& every = {});
// Returns a sentence for each unread key to which a scene's file gives another value than its usual one,
// except those that flags of the line set.
std::vector<std::string> unread_key_warnings(const CommandLine& line, const KeyValues& values,
                                             const KeyValues& usual);

// Returns the flags of the line that are still read with that change, for a repetition with it.
std::vector<Flag> without_unread_flags(const CommandLine& line, const Flag& change);

}  // namespace hysteron::experiments
