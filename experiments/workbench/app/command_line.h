// Parses the shell's words into a CommandLine.
#pragma once

#include <optional>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Parses `words`, the first of which is the program's name.  Returns nothing if help or the version was
// requested and printed.  Throws Error::invalid_input in one line for unknown subcommands and flags (with the
// nearest name) and missing values.
std::optional<CommandLine> parse_command_line(const std::vector<std::string>& words,
                                              const std::vector<Experiment>& known = experiments());

// Returns the options of a subcommand in the order of --help: its own, then those of every simulated run.
// Their defaults, and with them the fabric's file, are read only to be shown.
enum class Defaults { left_out, shown };
std::vector<KeyDescription> experiment_options(const Experiment& experiment, Defaults defaults);
// Returns the option as typed: "--fabric", "--step".
std::string option_name(const KeyDescription& key);

// Quotes words as a line that a shell splits into them again.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace hysteron::experiments
