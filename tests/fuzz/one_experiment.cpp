// A program that reads files only has no solver: one experiment stands for those that manifests and studies
// name, and no run has others beside it.
#include "experiments/workbench/app/experiment.h"
#include "sim/time/together.h"

namespace hysteron {

int jobs_together() { return 1; }

}  // namespace hysteron

namespace hysteron::experiments {

namespace {

const Catalogue one([]() -> std::vector<Experiment> {
  return {{.name = "swing",
           .question = "",
           .run = [](const CommandLine&) { return 0; },
           .simulates = true,
           .defaults = [] { return Setup(); }}};
});

}  // namespace
}  // namespace hysteron::experiments
