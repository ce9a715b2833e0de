#include "experiments/compare/tuning.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/session/driver.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

std::string geometric_middle(const std::string& low, const std::string& high) {
  return number_text(std::sqrt(*number_in(low) * *number_in(high)), 4);
}

// The first column with one more key, "linear+fabric.damping=1e-3", by a name that none of the others has.
Variant with_key(const std::string& experiment, const std::vector<Variant>& variants, const std::string& key,
                 const std::string& number) {
  Variant variant = variants.at(0);
  variant.flags.push_back(parsed_flag(experiment, key, number));
  const std::string name = folder_name(variant.name + "+" + key + "=" + number);
  variant.name = name;
  const auto is_taken = [&] {
    return std::any_of(variants.begin() + 1, variants.end(),
                       [&](const Variant& other) { return other.name == variant.name; });
  };
  for (int again = 2; is_taken(); ++again) variant.name = name + "-" + std::to_string(again);
  return variant;
}

double metric_in(const ChildRun& column, const std::string& metric) {
  if (!column.stopped.empty())
    throw Error::simulation("compare.tune: " + column.name + ": " + column.stopped);
  const double value = column.metrics().number(metric);
  if (std::isnan(value))
    throw Error::invalid_input(column.name + " has no metric " + metric +
                               " that is a number (--compare.tune-metric)")
        .with_key("compare.tune-metric", metric);
  return value;
}

// Returns the first column with a number for the tuned key, and the second one.
Plan tried_columns(const CommandLine& inner, const std::vector<Variant>& variants, CompareParams choice,
                   const Options& options, const std::string& key, const std::string& number) {
  CommandLine line = inner;
  const Flag no_images = {"no-images", true};
  line.flags = override_flags(without_unread_flags(line, no_images), {no_images});
  choice.to.clear();
  return comparison_plan(line, {with_key(inner.experiment, variants, key, number), variants[1]}, choice,
                         std::filesystem::path(options.out) / "tries");
}

}  // namespace

Tuning parsed_tuning(const std::string& key_and_bracket, const std::string& metrics) {
  const auto refuse = [&](const std::string& must) {
    return Error::invalid_input("compare.tune = " + key_and_bracket + " must be " + must +
                                " (--compare.tune)")
        .with_key("compare.tune", key_and_bracket);
  };
  const std::size_t equals = key_and_bracket.find('='), colon = key_and_bracket.find(':', equals);
  if (equals == 0 || colon == std::string::npos)
    throw refuse("KEY=LOW:HIGH, such as fabric.damping=1e-5:1e-1");
  Tuning tuning;
  tuning.key = key_and_bracket.substr(0, equals);
  tuning.low = key_and_bracket.substr(equals + 1, colon - equals - 1);
  tuning.high = key_and_bracket.substr(colon + 1);
  const std::optional<double> low = number_in(tuning.low), high = number_in(tuning.high);
  if (!low || !high || !(*low > 0 && *low < *high && std::isfinite(*high)))
    throw refuse("a bracket with 0 < LOW < HIGH");
  if (metrics.empty())
    throw Error::invalid_input(
        "compare.tune needs what is to be equal: --compare.tune-metric METRIC, or METRIC=METRIC of the "
        "second "
        "column")
        .with_key("compare.tune-metric", "");
  const std::size_t between = metrics.find('=');
  tuning.metric = metrics.substr(0, between);
  tuning.target = between == metrics.npos ? metrics : metrics.substr(between + 1);
  return tuning;
}

std::string tuned(const Tuning& tuning, const Excess& excess) {
  const double at_low = excess(tuning.low), at_high = excess(tuning.high);
  if ((at_low < 0) == (at_high < 0))
    throw Error::invalid_input(tuning.metric + " is " + (at_low < 0 ? "below" : "not below") +
                               " the second column's " + tuning.target + " at both ends of " + tuning.key +
                               " = " + tuning.low + ":" + tuning.high +
                               ": widen the bracket (--compare.tune)")
        .with_key("compare.tune", tuning.key + "=" + tuning.low + ":" + tuning.high);
  std::string low = tuning.low, high = tuning.high, best = low;
  double least = std::abs(at_low);
  const auto keep_best = [&](const std::string& number, double found) {
    if (std::abs(found) <= least) best = number, least = std::abs(found);
  };
  keep_best(high, at_high);
  for (int i = 0; i < kBisections; ++i) {
    const std::string middle = geometric_middle(low, high);
    const double found = excess(middle);
    ((found < 0) == (at_low < 0) ? low : high) = middle;
    keep_best(middle, found);
  }
  return best;
}

void check_tuning(const CommandLine& inner, const std::vector<Variant>& variants, const CompareParams& choice,
                  const Options& options) {
  const Tuning tuning = parsed_tuning(choice.tune, choice.tune_metric);
  if (variants.size() < 2)
    throw Error::invalid_input(
        "compare.tune needs two columns, the one to tune and its target (--compare.tune)")
        .with_key("compare.tune", choice.tune);
  for (const std::string& number : {tuning.low, tuning.high})
    check_columns(tried_columns(inner, variants, choice, options, tuning.key, number).columns);
}

Json tune_first_column(Run& run, const CommandLine& inner, std::vector<Variant>& variants,
                       const CompareParams& choice, SweepJobs jobs, const Options& options) {
  const Tuning tuning = parsed_tuning(choice.tune, choice.tune_metric);
  const auto say = [&](const std::string& line) { run.progress(line); };
  std::map<std::string, double> missed;  // relative excess over the target, by number
  const Excess excess = [&](const std::string& number) {
    Plan plan = tried_columns(inner, variants, choice, options, tuning.key, number);
    for (const ChildRun& column : plan.columns) run.add_part(column.folder, jobs.resume);
    run_columns(
        plan.columns, jobs, [](const ChildRun&) {}, say);
    jobs.resume = true;  // so that the second column, which never changes, is reused
    const double own = metric_in(plan.columns[0], tuning.metric),
                 target = metric_in(plan.columns[1], tuning.target);
    say(tuning.key + "=" + number + ": " + tuning.metric + " " + number_text(own, 4) + ", target " +
        number_text(target, 4));
    missed[number] = 100 * (own - target) / std::abs(target);
    return own - target;
  };
  const std::string number = tuned(tuning, excess);
  variants[0] = with_key(inner.experiment, variants, tuning.key, number);
  (options.json ? std::cerr : std::cout) << tuning.key << "=" << number << std::endl;
  constexpr double kMissed = 1;  // [%]
  if (std::abs(missed[number]) > kMissed)
    run.warn(fmt::format("compare.tune: the nearest number that was tried misses the target by {:.2g} %",
                         missed[number]));
  return {{"column", variants[0].name}, {"key", tuning.key},       {"value", *number_in(number)},
          {"metric", tuning.metric},    {"target", tuning.target}, {"missed_percent", missed[number]}};
}

}  // namespace hysteron::experiments
