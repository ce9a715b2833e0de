// Keys of scenes that an experiment decides: a flag of one is refused, a file that sets one is told of.
#pragma once

#include <set>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// All keys that begin so but these, which are not used.
std::vector<DecidedKey> unused_but(const std::string& beginning, const std::set<std::string>& used,
                                   const std::string& why);

// "fold sets cloth.shape itself: the specimen is a strip"
std::string decided_words(const std::string& experiment, const DecidedKey& key);

// Error::invalid_input where a flag sets one of the keys, "--cloth.shape disc: fold sets cloth.shape itself:
// ...".
void throw_if_flags(const CommandLine& line, const std::vector<DecidedKey>& decided);
// The same; and the set-up remembers them, for lost_words().
void decide(const CommandLine& line, Setup& setup, const std::vector<DecidedKey>& keys);

// Sets where the key is shown to come from, "set by fold: the specimen is a strip", for a scene whose key the
// experiment has changed.
void note_setter(Scene& scene, const std::string& experiment, const DecidedKey& key);

// What a scene's file asks for that the experiment has not done: a sentence for each such key, with its
// place.  `setup` is as the experiment has changed it.
std::vector<std::string> lost_words(const CommandLine& line, const Setup& setup);

// Pins and obstacles of the scene that come when it is over: a sentence for each.
std::vector<std::string> late_table_warnings(const Scene& scene);
// Throws Error::invalid_input for the first of them, unless --seconds or --quick has made the scene shorter
// than its file has it.
void refuse_late_tables(const Setup& setup);

}  // namespace hysteron::experiments
