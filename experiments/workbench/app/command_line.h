// From the shell's words to a CommandLine.
#pragma once

#include <optional>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// `words`: the program's own name first.  Nothing if help or the version was asked for and printed.  Throws
// Error::invalid_input in one line for what cannot be understood: unknown subcommands and flags (with the
// nearest name), missing values.
std::optional<CommandLine> parse_command_line(const std::vector<std::string>& words,
                                              const std::vector<Experiment>& known = experiments());

// The options of a subcommand in the order of --help: its own, then those of every simulated run.  Their
// defaults, and with them the fabric's file, are read only to be shown.
enum class Defaults { left_out, shown };
std::vector<KeyDescription> experiment_options(const Experiment& experiment, Defaults defaults);
// As it is typed: "--fabric", "--step".
std::string option_name(const KeyDescription& key);

// Words as a line that a shell takes apart into them again.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace hysteron::experiments
