// This file lists every subcommand, in the order of --help.  Each has a folder of its name with a function
// that describes it; a new one needs such a folder and a line here.
#include "experiments/workbench/app/experiment.h"

// clang-format off
#define HYSTERON_EXPERIMENTS(entry) \
  entry(drape) \
  entry(crease) \
  entry(fold) \
  entry(crumple) \
  entry(swing) \
  entry(run_scenes) \
  entry(compare) \
  entry(sweep) \
  entry(kes) \
  entry(fab) \
  entry(cantilever) \
  entry(buckle) \
  entry(accuracy) \
  entry(validate) \
  entry(stability) \
  entry(bench) \
  entry(law) \
  entry(fit) \
  entry(render_files) \
  entry(diff) \
  entry(report) \
  entry(figures) \
  entry(rerun) \
  entry(verify) \
  entry(doctor) \
  entry(list) \
  entry(batch)
// clang-format on

namespace hysteron::experiments {

#define HYSTERON_DECLARE(name) Experiment name();
HYSTERON_EXPERIMENTS(HYSTERON_DECLARE)

namespace {

#define HYSTERON_LIST(name) name(),
const Catalogue all([]() -> std::vector<Experiment> { return {HYSTERON_EXPERIMENTS(HYSTERON_LIST)}; });

}  // namespace
}  // namespace hysteron::experiments
