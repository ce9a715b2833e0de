#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "experiments/command_line.h"
#include "sim/error.h"

namespace {

using namespace hysteron;
using namespace hysteron::experiments;

// "hysteron drape: fabric.b2 = -1 N m must be >= 0 (drape.toml:7)"; a message may name its experiment itself.
int fail(const std::string& experiment, std::string message, int exit_code) {
  const std::string prefix = experiment + ": ";
  if (!experiment.empty() && message.starts_with(prefix)) message.erase(0, prefix.size());
  std::cerr << "hysteron" << (experiment.empty() ? "" : " " + experiment) << ": " << message << std::endl;
  return exit_code;
}

}  // namespace

int main(int count, char** words) {
  std::string experiment;
  try {
    const std::optional<CommandLine> line = parse_command_line(count, words);
    if (!line) return 0;
    experiment = line->experiment;
    const Experiment& chosen = experiment_named(experiment);
    if (!chosen.run) throw Error::request("not built yet");
    const int exit_code = chosen.run(*line);
    if (!std::cout.flush()) throw Error::machine("cannot write to standard output");
    return exit_code;
  } catch (const Error& error) {
    return fail(experiment, error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return fail(experiment, "out of memory; use fewer triangles (--triangles)", 1);
  } catch (const std::exception& error) {
    return fail(experiment, std::string("unexpected failure: ") + error.what(), 1);
  }
}
