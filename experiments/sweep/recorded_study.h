// A study in the manifest of its sweep, which outlives the file that it was read from.
#pragma once

#include <string>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/manifest.h"
#include "sim/scene/value_tree.h"

namespace hysteron::experiments {

// What the manifest keeps of it.
Json study_record(const Study& study);

// Those as a study file would have them, beside what it cannot say: "scale" and "sampled" of an axis whose
// values stand there.  Throws Error::invalid_input, naming `file`, where the manifest is not of a sweep.
ValueTree recorded_study(const Manifest& manifest, const std::string& file);

}  // namespace hysteron::experiments
