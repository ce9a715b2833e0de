// The catalogue of a program that reads files only: one experiment stands for those that manifests and
// studies name, so that no other has to be compiled.
#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> one = {{.name = "swing",
                                               .question = "",
                                               .run = [](const CommandLine&) { return 0; },
                                               .simulates = true,
                                               .defaults = [] { return Setup(); }}};
  return one;
}

}  // namespace hysteron::experiments
