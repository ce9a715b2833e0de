#include "experiments/sweep/outcome.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kOutcome = "outcome.json";
// Exit codes.
constexpr int kNotRun = -1, kRefused = 2;

}  // namespace

void write_outcome(const ChildRun& run) {
  std::error_code failure;
  std::filesystem::create_directories(run.folder, failure);
  if (failure)
    throw Error::system("cannot create the folder " + run.folder.string() + ": " + failure.message());
  const Json outcome = {{"exit_code", run.exit_code}, {"stopped", run.stopped}};
  write_text(run.folder / kOutcome, outcome.dump(2) + "\n");
}

bool is_settled(const ChildRun& run) { return run.exit_code == kRefused || run.exit_code == kCouldNotGoOn; }

void recall_outcome(ChildRun& run) {
  if (recall(run)) return;
  const Json outcome = json_or_none(run.folder / kOutcome);
  const bool known = outcome.is_object() && outcome.value("exit_code", Json()).is_number_integer() &&
                     outcome.value("stopped", Json()).is_string();
  run.exit_code = known ? outcome["exit_code"].get<int>() : kNotRun;
  run.stopped = known ? outcome["stopped"].get<std::string>() : "";
  if (run.stopped.empty()) run.stopped = "not run", run.exit_code = kNotRun;
  if (run.exit_code == kCouldNotGoOn) run.manifest = manifest_or_none(run.folder / "manifest.json");
}

}  // namespace hysteron::experiments
