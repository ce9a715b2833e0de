#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>

#include "experiments/notes/notes.h"
#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/closing_summary.h"
#include "experiments/workbench/session/driver.h"
#include "sim/base/error.h"

namespace {

using namespace hysteron;
using namespace hysteron::experiments;

// Prints the summary of a run on stdout, but not with --json, where stdout holds JSON alone, and not for
// subcommands that scripts call.
void print_summary(const CommandLine& line) {
  if (Run::first_folder().empty() || last_text(line.flags, "json", "") == "true") return;
  if (experiment_named(line.experiment).hidden) return;
  std::cout << closing_summary(Run::first_folder());
  if (last_text(line.flags, "quiet", "") != "true") std::cout << closing_notes(Run::first_folder());
  std::cout << std::flush;
}

// Shortens how long waiting OpenMP threads spin.  GNU's library lets them spin 300,000 rounds, and where
// another program wants the cores, steps of small cloth then take up to thirty times as long.  The library
// reads the number when it is loaded, so the program starts itself anew with a smaller one, once, unless its
// user has said how to wait.
void spin_shortly(char** words) {
  constexpr const char* kRounds = "10000";
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  setenv("GOMP_SPINCOUNT", kRounds, 0);
  execv("/proc/self/exe", words);  // returns where /proc is missing: the threads then spin for long
}

int flushed(int exit_code) {
  if (!std::cout.flush() || std::ferror(stdout)) throw Error::system("cannot write to standard output");
  return exit_code;
}

}  // namespace

int main(int count, char** words) {
  spin_shortly(words);
  std::string experiment;
  std::optional<CommandLine> line;
  const ExitStatus ending = run_guarded(experiment, [&] {
    line = parse_command_line({words, words + count});
    if (!line) return flushed(0);
    experiment = line->experiment;
    choose_gpu(*line);
    const int exit_code = run_experiment(*line);
    print_summary(*line);
    return flushed(exit_code);
  });
  if (ending.error.empty()) return ending.exit_code;
  if (line && ending.exit_code == kCouldNotGoOn) print_summary(*line);
  // Files that could not be written are reported, unless the machine's failure is the reason.
  if (ending.exit_code != kMachineFailed && !Run::unwritten().empty())
    std::cerr << "hysteron: " << Run::unwritten() << std::endl;
  std::cerr << ending.error << std::endl;
  return ending.exit_code;
}
