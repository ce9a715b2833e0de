// Formats what --help prints: options by group, as wide as the terminal.
#pragma once

#include <optional>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

struct OptionGroup {
  std::string name;   // name that --help takes: "fabric"
  std::string about;  // description: "the fabric's numbers, the law of bending and its parameters"
  std::vector<KeyDescription> keys;
};
// Returns the experiment's own options first, under its name, even if there are none; then those of scenes
// and runs.
std::vector<OptionGroup> option_groups(const Experiment& experiment, std::vector<KeyDescription> keys);

// Returns the columns of the terminal on stdout, or as COLUMNS says; 100 without one.
int terminal_width();

// Returns the answer to --help, -h, --help GROUP or --help-all among the words behind `hysteron`; nothing if
// they do not ask.  Throws Error::invalid_input for an unknown group.
std::optional<std::string> help_asked(const std::vector<std::string>& words,
                                      const std::vector<Experiment>& known, int width);

}  // namespace hysteron::experiments
