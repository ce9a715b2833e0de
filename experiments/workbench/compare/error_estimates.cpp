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
std::string words_of(const std::vector<Flag>& flags) {
  std::string words;
  for (const Flag& flag : flags) words += (words.empty() ? "--" : " --") + flag.path + "=" + flag.text;
  return words;
}

class Estimate {
 public:
  Estimate(const std::vector<std::string>& headlines, const Metrics& metrics,
           const std::vector<ErrorRunResult>& repeats)
      : run_(metrics), repeats_(repeats) {
    for (const std::string& name : headlines)
      if (metrics[name].is_number()) names_.push_back(name);
    for (const ErrorRunResult& r : repeats_) usable_.push_back(is_usable(r));
  }

  Errors errors() {
    for (const std::string& name : names_) {
      single(name, "step", kStepError);
      single(name, "mesh", kMeshError);
      draws(name);
      path(name);
    }
    return std::move(errors_);
  }

 private:
  // A repeat that leaves every bit as it was tells nothing of an error: what it changes is not used.  Two
  // paths may be the same.
  static bool unused(const ErrorRunResult& r) { return r.unchanged && r.repeat.name != "path"; }

  bool is_usable(const ErrorRunResult& r) {
    const std::string what = r.repeat.name + " (" + words_of(r.repeat.changes) + ")";
    if (!r.stopped.empty())
      errors_.missing.push_back(what + " is not complete: " + r.stopped);
    else if (unused(r))
      errors_.missing.push_back(what + " changes no bit of the run, so it says nothing of an error");
    return r.stopped.empty() && !unused(r);
  }

  // The headline's values in the repeats of that name, "draw-2" being a "draw".
  std::vector<double> values(const std::string& name, const std::string& kind) {
    std::vector<double> found;
    for (std::size_t i = 0; i < repeats_.size(); ++i) {
      const std::string& own = repeats_[i].repeat.name;
      if (!usable_[i] || own.substr(0, own.find('-')) != kind) continue;
      if (const MetricValue& value = repeats_[i].metrics[name]; value.is_number())
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

  void draws(const std::string& name) {
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
    const bool asked = std::any_of(repeats_.begin(), repeats_.end(),
                                   [](const ErrorRunResult& r) { return r.repeat.name == "path"; });
    if (!asked) return;
    const std::vector<double> found = values(name, "path");
    errors_.metrics.set(name + kPathDifference, found.empty() ? MetricValue() : found[0] - of_run(name));
  }

  const Metrics& run_;
  const std::vector<ErrorRunResult>& repeats_;
  std::vector<std::string> names_;
  std::vector<bool> usable_;
  Errors errors_;
};

}  // namespace

Errors errors_of(const std::string& experiment, const Metrics& metrics,
                 const std::vector<ErrorRunResult>& repeats, const std::vector<std::string>& asked) {
  const Headlines& headlines = headlines_of(experiment);
  std::vector<std::string> names = headlines.with_errors();
  names.insert(names.end(), asked.begin(), asked.end());
  Errors errors = Estimate(names, metrics, repeats).errors();
  const bool of_a_file = std::any_of(repeats.begin(), repeats.end(), [](const ErrorRunResult& r) {
    return !r.repeat.changes.empty() && r.repeat.changes.front().path == kSubdivisions;
  });
  if (of_a_file) errors.missing.push_back("draw: the cloth's triangles come from a file");
  if (headlines.equilibria)
    errors.missing.push_back("step: " + experiment + " finds equilibria at loads that --step does not set");
  return errors;
}

}  // namespace hysteron::experiments
