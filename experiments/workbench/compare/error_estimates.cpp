// From the metrics of repeats to the errors of a run.
#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/compare/errors.h"
#include "experiments/workbench/pages/error_words.h"

namespace hysteron::experiments {
namespace {

constexpr std::size_t kDrawsForAMean = 3;

// "--step=0.0005 --seed=2"
std::string flag_words(const std::vector<Flag>& flags) {
  std::string words;
  for (const Flag& flag : flags) words += (words.empty() ? "--" : " --") + flag.path + "=" + flag.text;
  return words;
}

class Estimate {
 public:
  Estimate(const std::vector<std::string>& headlines, const Metrics& metrics,
           const std::vector<ErrorRunResult>& error_runs)
      : run_(metrics), error_runs_(error_runs) {
    for (const std::string& name : headlines)
      if (metrics[name].is_number()) names_.push_back(name);
    for (const ErrorRunResult& r : error_runs_) usable_.push_back(is_usable(r));
  }

  Errors errors() {
    for (const std::string& name : names_) {
      single(name, "step", kStepError);
      single(name, "mesh", kMeshError);
      mesh_samples(name);
      path(name);
    }
    return std::move(errors_);
  }

 private:
  // A repeat that leaves every bit as it was tells nothing of an error: what it changes is not used.  Two
  // paths may be the same.
  static bool unused(const ErrorRunResult& r) { return r.unchanged && r.error_run.name != "path"; }

  bool is_usable(const ErrorRunResult& r) {
    const std::string what = r.error_run.name + " (" + flag_words(r.error_run.changes) + ")";
    if (!r.stopped.empty())
      errors_.missing.push_back(what + " is not complete: " + r.stopped);
    else if (unused(r))
      errors_.missing.push_back(what + " changes no bit of the run, so it says nothing of an error");
    return r.stopped.empty() && !unused(r);
  }

  // The headline's values in the repeats of that name, "draw-2" being a "draw".
  std::vector<double> values(const std::string& name, const std::string& kind) {
    std::vector<double> found;
    for (std::size_t i = 0; i < error_runs_.size(); ++i) {
      const std::string& own = error_runs_[i].error_run.name;
      if (!usable_[i] || own.substr(0, own.find('-')) != kind) continue;
      if (const MetricValue& value = error_runs_[i].metrics[name]; value.is_number())
        found.push_back(value.number());
      else
        errors_.missing.push_back(own + " has no " + name);
    }
    return found;
  }

  double of_run(const std::string& name) const { return run_[name].number(); }

  void single(const std::string& name, const std::string& kind, const char* ending) {
    const std::vector<double> found = values(name, kind);
    errors_.metrics.set(name + ending, found.empty() ? MetricValue() : std::abs(found[0] - of_run(name)));
  }

  void mesh_samples(const std::string& name) {
    std::vector<double> all = values(name, "draw");
    errors_.metrics.set(name + kDrawError, {});
    if (all.empty()) return;
    all.push_back(of_run(name));
    const double n = static_cast<double>(all.size());
    double mean = 0, squares = 0;
    for (double value : all) mean += value;
    mean /= n;  // of counts that are alike that count itself
    for (double value : all) squares += (value - mean) * (value - mean);
    const double deviation = std::sqrt(squares / (n - 1));
    errors_.metrics.set(name + kDrawError, deviation);
    if (all.size() <= kDrawsForAMean) return;  // the run itself is one of them
    errors_.metrics.set(name + kDrawMean, mean);
    errors_.metrics.set(name + kDrawMeanError, deviation / std::sqrt(n));
  }

  void path(const std::string& name) {
    const bool requested = std::any_of(error_runs_.begin(), error_runs_.end(),
                                       [](const ErrorRunResult& r) { return r.error_run.name == "path"; });
    if (!requested) return;
    const std::vector<double> found = values(name, "path");
    errors_.metrics.set(name + kPathDifference, found.empty() ? MetricValue() : found[0] - of_run(name));
  }

  const Metrics& run_;
  const std::vector<ErrorRunResult>& error_runs_;
  std::vector<std::string> names_;
  std::vector<bool> usable_;
  Errors errors_;
};

}  // namespace

Errors estimated_errors(const std::string& experiment, const Metrics& metrics,
                        const std::vector<ErrorRunResult>& error_runs,
                        const std::vector<std::string>& requested) {
  const Headlines& headlines = experiment_headlines(experiment);
  std::vector<std::string> names = headlines.with_errors();
  names.insert(names.end(), requested.begin(), requested.end());
  Errors errors = Estimate(names, metrics, error_runs).errors();
  const bool of_a_file = std::any_of(error_runs.begin(), error_runs.end(), [](const ErrorRunResult& r) {
    return !r.error_run.changes.empty() && r.error_run.changes.front().path == kSubdivisions;
  });
  if (of_a_file) errors.missing.push_back("draw: the cloth's triangles come from a file");
  if (headlines.equilibria)
    errors.missing.push_back("step: " + experiment + " finds equilibria at loads that --step does not set");
  return errors;
}

}  // namespace hysteron::experiments
