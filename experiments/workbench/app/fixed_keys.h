// Keys of scenes that an experiment fixes: a flag of one is refused, a file that sets one gets a warning.
#pragma once

#include <set>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Returns all keys that begin with `beginning`, except the used ones, as keys that are not used.
std::vector<FixedKey> unused_but(const std::string& beginning, const std::set<std::string>& used,
                                 const std::string& why);

// Returns "fold sets cloth.shape itself: the specimen is a strip".
std::string fixed_key_message(const std::string& experiment, const FixedKey& key);

// Throws Error::invalid_input if a flag sets one of the keys, "--cloth.shape disc: fold sets cloth.shape
// itself: ...".
void throw_if_flags(const CommandLine& line, const std::vector<FixedKey>& fixed_keys);
// Does the same, and records the keys in the set-up for ignored_key_warnings().
void decide(const CommandLine& line, Setup& setup, const std::vector<FixedKey>& keys);

// Records where the key is shown to come from, "set by fold: the specimen is a strip", for a scene whose key
// the experiment has changed.
void note_setter(Scene& scene, const std::string& experiment, const FixedKey& key);

// Returns a sentence, with its place, for each key of a scene's file that the experiment has overridden.
// `setup` is as the experiment has changed it.
std::vector<std::string> ignored_key_warnings(const CommandLine& line, const Setup& setup);

// Returns a sentence for each pin and obstacle of the scene that begins after its end.
std::vector<std::string> late_table_warnings(const Scene& scene);
// Throws Error::invalid_input for the first of them, unless --seconds or --quick has made the scene shorter
// than its file has it.
void refuse_late_tables(const Setup& setup);

}  // namespace hysteron::experiments
