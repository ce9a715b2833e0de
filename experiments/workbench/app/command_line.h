// From argv to a CommandLine.
#pragma once

#include <optional>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Nothing if help or the version was asked for and printed.  Throws Error::request in one line for what
// cannot be understood: unknown subcommands and flags (with the nearest name), missing values.
std::optional<CommandLine> parse_command_line(int count, const char* const* words,
                                              const std::vector<Experiment>& known = experiments());

// Words as a line that a shell takes apart into them again.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace hysteron::experiments
