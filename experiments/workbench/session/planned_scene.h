// What a run would simulate, without the run.
#pragma once

#include <optional>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// The scene as the experiment of that line changes it; nothing where it simulates no cloth.  Throws what the
// run would throw before its first step.
std::optional<Scene> planned_scene(CommandLine line);

}  // namespace hysteron::experiments
