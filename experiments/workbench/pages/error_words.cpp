#include "experiments/workbench/pages/error_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "experiments/workbench/pages/manifest.h"

namespace hysteron::experiments {
namespace {

struct Source {
  const char* ending;
  const char* word;
};
constexpr Source kSources[] = {{kStepError, "step"}, {kMeshError, "mesh"}, {kDrawError, "draw"}};

bool is_number(const Json& metrics, const std::string& name) {
  return metrics.contains(name) && metrics[name].is_number() && std::isfinite(metrics[name].get<double>());
}

// The power of ten that an error is rounded to.
int place_of(double error) {
  char text[40];
  std::snprintf(text, sizeof text, "%.0e", error);  // "8e-01"
  return std::atoi(text + 2) - (text[0] == '1' ? 1 : 0);
}

// To 10^place; small numbers in powers of ten.
std::string rounded(double x, int place) {
  constexpr int kSmallest = -3;  // first digit's place
  const int first = x == 0 ? place : static_cast<int>(std::floor(std::log10(std::abs(x))));
  char text[64];
  if (x != 0 && first < kSmallest)
    std::snprintf(text, sizeof text, "%.*e", std::max(0, first - place), x);
  else
    std::snprintf(text, sizeof text, "%.*f", std::max(0, -place), x);
  return text;
}

std::string rounded_error(double error) { return error > 0 ? rounded(error, place_of(error)) : "0"; }

// With the decimals of its largest error.
std::string value_text(const Json& value, double largest) {
  if (value.is_number_integer()) return value.dump();
  if (largest > 0) return rounded(value.get<double>(), place_of(largest));
  return shown(value);
}

}  // namespace

bool is_headline(const Json& metrics, const std::string& name) {
  return is_number(metrics, name) &&
         std::any_of(std::begin(kSources), std::end(kSources),
                     [&](const Source& source) { return metrics.contains(name + source.ending); });
}

std::string headline_of(const Json& metrics, const std::string& name) {
  for (const char* ending :
       {kStepError, kMeshError, kDrawError, kDrawMeanError, kDrawMean, kPathDifference}) {
    const std::string end = ending;
    if (!name.ends_with(end)) continue;
    const std::string headline = name.substr(0, name.size() - end.size());
    if (is_headline(metrics, headline)) return headline;
  }
  return "";
}

HeadlineWords headline_words(const Json& metrics, const std::string& name) {
  HeadlineWords words;
  words.unit = split_unit(name).unit;
  double largest = 0;
  std::string unknown;
  for (const Source& source : kSources) {
    const std::string key = name + source.ending;
    if (is_number(metrics, key)) {
      const double error = metrics[key].get<double>();
      largest = std::max(largest, error);
      words.errors += (words.errors.empty() ? "± " : " ± ") + rounded_error(error) + " " + source.word;
    } else {
      unknown += (unknown.empty() ? "" : " and ") + std::string(source.word);
    }
  }
  if (!unknown.empty()) words.errors += (words.errors.empty() ? "" : ", ") + unknown + " error unknown";
  if (is_number(metrics, name + kPathDifference)) {
    const double difference = metrics[name + kPathDifference].get<double>();
    words.errors +=
        std::string(", other path ") + (difference < 0 ? "-" : "+") + rounded_error(std::abs(difference));
  }
  if (is_number(metrics, name + kDrawMean) && is_number(metrics, name + kDrawMeanError)) {
    const double error = metrics[name + kDrawMeanError].get<double>();
    words.errors +=
        ", mean of draws " + value_text(metrics[name + kDrawMean], error) + " ± " + rounded_error(error);
  }
  words.value = value_text(metrics.at(name), largest);
  return words;
}

std::string with_errors(const Json& metrics, const std::string& name) {
  if (!is_headline(metrics, name)) return metric_text(name, metrics.at(name).get<double>());
  const HeadlineWords words = headline_words(metrics, name);
  return split_unit(name).name + " " + words.value + (words.unit.empty() ? "" : " " + words.unit) + " " +
         words.errors;
}

}  // namespace hysteron::experiments
