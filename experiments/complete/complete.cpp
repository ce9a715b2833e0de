// `hysteron complete -- WORDS`: what a shell offers for the last of them, by hysteron.bash and _hysteron.
#include <iostream>

#include "experiments/complete/candidates.h"
#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {
namespace {

// A line for each candidate: the word and, behind a tab, what it means.
int run_complete(const CommandLine& line) {
  for (const Candidate& candidate : candidates(line.names)) {
    std::cout << candidate.word;
    if (!candidate.meaning.empty()) std::cout << '\t' << candidate.meaning;
    std::cout << '\n';
  }
  return 0;
}

}  // namespace

Experiment complete() {
  return {.name = "complete",
          .question = "words that may stand at the end of a command line, for shells",
          .run = run_complete,
          .names = "WORDS",
          .hidden = true};
}

}  // namespace hysteron::experiments
