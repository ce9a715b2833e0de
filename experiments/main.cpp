#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <string>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/closing_words.h"
#include "sim/base/error.h"

namespace {

using namespace hysteron;
using namespace hysteron::experiments;

// "hysteron drape: fabric.b2 = -1 N m must be >= 0 (drape.toml:7)"
int fail(const std::string& experiment, const std::string& message, int exit_code) {
  std::cerr << "hysteron" << (experiment.empty() ? "" : " ") << experiment << ": " << message << std::endl;
  return exit_code;
}

int fail(const std::string& experiment, const Error& error) {
  if (error.experiment().empty()) return fail(experiment, error.what(), error.exit_code());
  std::cerr << "hysteron " << error.what() << std::endl;
  return error.exit_code();
}

// With --json stdout is for JSON alone.
void say_last_words(const std::optional<CommandLine>& line) {
  if (!line || Run::first_folder().empty() || last_text(line->flags, "json", "") == "true") return;
  std::cout << closing_words(Run::first_folder()) << std::flush;
}

}  // namespace

int main(int count, char** words) {
  std::string experiment;
  std::optional<CommandLine> line;
  try {
    line = parse_command_line(count, words);
    if (!line) return 0;
    experiment = line->experiment;
    const Experiment& chosen = experiment_named(experiment);
    if (!chosen.run) throw Error::request("not built yet");
    choose_gpu(*line);
    const int exit_code = chosen.run(*line);
    say_last_words(line);
    if (!std::cout.flush()) throw Error::machine("cannot write to standard output");
    return exit_code;
  } catch (const Error& error) {
    if (error.exit_code() == kCouldNotGoOn) say_last_words(line);
    return fail(experiment, error);
  } catch (const std::bad_alloc&) {
    return fail(experiment, "out of memory; use fewer triangles (--triangles)", 1);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(experiment, "cannot use " + error.path1().string() + ": " + error.code().message(), 1);
  } catch (const std::exception& error) {
    return fail(experiment, std::string("unexpected failure: ") + error.what(), 1);
  }
}
