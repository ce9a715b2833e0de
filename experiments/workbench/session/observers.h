// Who watches every run, in which order.
#pragma once

#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/resuming.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

// In the order of their calls: metrics.csv, whose row the experiment measures, probes, pictures, which show a
// probe's loop, what the solver says, crossings, folds, recoveries, meshes, errors, checkpoints, which go
// when all else is there.  Refuses files that Run::reserve() does.
Observers observers_of(Session& session, std::unique_ptr<Probes> probes,
                       std::unique_ptr<Checkpoints> checkpoints);

}  // namespace hysteron::experiments
