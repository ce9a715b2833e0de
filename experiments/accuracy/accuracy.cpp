// `hysteron accuracy`: error against run time, for problems with references of their own.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/accuracy/output.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/time/together.h"

namespace hysteron::experiments {
namespace {

struct AccuracyFlags {
  std::string problem = "all", device = "cpu";
  int batch = 1;
  Options options;
};

using F = AccuracyFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"problem", at<&F::problem>, "", any(), "", "bend, sag, droop, buckle, decay, swing, crease; several separated by commas, or all"},
    {"device", at<&F::device>, "", any(), "cpu | cuda", "where settings are computed, one after the other; on the cpu by one thread"},
    {"batch", at<&F::batch>, "", between(1, 1024), "", "of settings on cuda: how many share its launches; from 2 on their times are not known, and nothing is said of what is cheapest"},
};
// clang-format on

Keys keys_of(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

std::vector<Problem> problems_of(const F& flags) {
  const Effort effort{flags.options.quick, value_named<DeviceChoice>(flags.device)};
  std::vector<Problem> all;
  for (const auto& make : {bend_problem, sag_problem, droop_problem, buckle_problem, decay_problem,
                           swing_problem, crease_problem})
    all.push_back(make(effort));
  if (flags.problem == "all") return all;
  std::vector<Problem> chosen;
  for (const std::string& name : split(flags.problem)) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Problem& problem) { return problem.name == name; });
    if (found == all.end()) {
      std::string known;
      for (const Problem& problem : all) known += (known.empty() ? "" : ", ") + problem.name;
      throw Error::request("problem = " + name + " is not one of: " + known)
          .of("problem", name)
          .in("accuracy");
    }
    chosen.push_back(*found);
  }
  return chosen;
}

// Settings that cannot be solved are findings too; a machine that fails is not.
Found tried(const Problem& problem, const Setting& setting) {
  try {
    Found found = problem.solve(setting);
    if (jobs_together() > 1) found.seconds = NAN;
    return found;
  } catch (const Error& error) {
    if (error.exit_code() == 1) throw;
    Found found;
    found.failed = error.what();
    return found;
  }
}

std::string words_of(const Found& found) {
  if (!found.failed.empty()) return found.failed;
  return fmt::format("error {:.3g}", found.error) +
         (found.is_timed() ? fmt::format(", {:.3g} s", found.seconds) : "");
}

Solution solved(const Problem& problem, const F& flags, Run& run) {
  Solution solution{problem, {}};
  for (const Setting& setting : problem.settings) solution.solved.push_back({setting, {}});
  const auto solve = [&](int i) {
    auto& [setting, found] = solution.solved[static_cast<std::size_t>(i)];
    found = tried(problem, setting);
    run.progress(fmt::format("{}, {}: {}", problem.name, describe(solution, setting), words_of(found)));
  };
  const int count = static_cast<int>(solution.solved.size());
  if (flags.device == "cuda" && flags.batch > 1) {
    if (problem.prepare) problem.prepare(problem.settings);
    run_together_by(flags.batch, count, 1, solve);
  } else {
    for (int i = 0; i < count; ++i) solve(i);
  }
  return solution;
}

int run_accuracy(const CommandLine& line) {
  F flags;
  set_keys(line, keys_of(flags));
  const std::vector<Problem> problems = problems_of(flags);
  Run run(line, flags.options, to_json(bind(kRows, flags)));
  run.reserve({"table.csv", "orders.csv", "cheapest.csv"});
  std::vector<Solution> solutions;
  for (const Problem& problem : problems) {
    solutions.push_back(solved(problem, flags, run));
    write_accuracy(run, solutions);  // a run that is cut short keeps what it has found
  }
  write_accuracy_metrics(run, solutions);
  if (!flags.options.no_images) draw_accuracy(run, solutions);
  finish_with_report(run);
  if (!flags.options.json) print_accuracy(solutions);
  return 0;
}

}  // namespace

Experiment accuracy() {
  return {
      .name = "accuracy",
      .question = "error against run time, against references of their own; orders; the cheapest settings",
      .run = run_accuracy,
      .own_keys = own_keys_of<keys_of>};
}

}  // namespace hysteron::experiments
