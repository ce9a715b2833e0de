#include "experiments/workbench/app/exit_status.h"

#include <exception>
#include <filesystem>
#include <new>

#include "sim/base/error.h"
#include "sim/base/job.h"

namespace hysteron::experiments {
namespace {

ExitStatus failed(const std::string& experiment, const std::string& message, int exit_code) {
  return {exit_code, "hysteron" + (experiment.empty() ? "" : " " + experiment) + ": " + message};
}

ExitStatus ending_of(const std::string& experiment, const std::function<int()>& body) {
  try {
    return {body()};
  } catch (const Error& error) {
    if (error.experiment().empty()) return failed(experiment, error.what(), error.exit_code());
    return {error.exit_code(), std::string("hysteron ") + error.what()};
  } catch (const std::bad_alloc&) {
    return failed(experiment,
                  "out of memory: use fewer triangles (--triangles), or allow more (--max-memory)", 1);
  } catch (const std::filesystem::filesystem_error& error) {
    return failed(experiment, "cannot use " + error.path1().string() + ": " + error.code().message(), 1);
  } catch (const std::exception& error) {
    return failed(experiment, std::string("unexpected failure: ") + error.what(), 1);
  }
}

}  // namespace

ExitStatus run_guarded(const std::string& experiment, const std::function<int()>& body) {
  Job job;
  ExitStatus ending = ending_of(experiment, body);
  job.end(ending.exit_code);
  return ending;
}

}  // namespace hysteron::experiments
