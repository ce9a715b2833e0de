#include "experiments/workbench/pages/error_notes.h"
#include "sim/base/number_in.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace hysteron::experiments {
namespace {

constexpr std::pair<const char*, const char*> kSources[] = {
    {kStepError, "step"}, {kMeshError, "mesh"}, {kDrawError, "draw"}};

bool is_number(const Metrics& metrics, const std::string& name) { return metrics[name].is_number(); }

// Returns the power of ten to which an error is rounded.
int decimal_place(double error) {
  const std::string text = fmt::format("{:.0e}", error);  // as in "8e-01"
  return std::atoi(text.c_str() + 2) - (text[0] == '1' ? 1 : 0);
}

// Rounds to 10^place; small numbers are in powers of ten.
std::string rounded(double x, int place) {
  constexpr int kSmallest = -3;  // place of the first digit
  const int first = x == 0 ? place : static_cast<int>(std::floor(std::log10(std::abs(x))));
  const bool small = x != 0 && first < kSmallest;
  return small ? fmt::format("{:.{}e}", x, std::max(0, first - place))
               : fmt::format("{:.{}f}", x, std::max(0, -place));
}

std::string rounded_error(double error) { return error > 0 ? rounded(error, decimal_place(error)) : "0"; }

// Formats a value times `scale` with the decimals of its largest error.
std::string value_text(const MetricValue& value, double largest, double scale) {
  if (value.is_integer() && scale == 1) return shown(value);
  if (largest > 0) return rounded(scale * value.number(), decimal_place(largest));
  return shown(scale == 1 ? value : MetricValue(scale * value.number()));
}

// Formats value and errors of a headline whose errors were measured.
ShownQuantity scaled_text(const Metrics& metrics, const std::string& name, double scale) {
  const auto metric_error = [&](const std::string& key) { return scale * std::abs(metrics[key].number()); };
  ShownQuantity words;
  double largest = 0;
  std::string unknown;
  for (const auto& [ending, source] : kSources) {
    const std::string key = name + ending;
    if (is_number(metrics, key)) {
      largest = std::max(largest, metric_error(key));
      words.errors = joined({words.errors, "± " + rounded_error(metric_error(key)), source}, " ");
    } else {
      unknown += (unknown.empty() ? "" : " and ") + std::string(source);
    }
  }
  if (!unknown.empty()) words.errors += (words.errors.empty() ? "" : ", ") + unknown + " error unknown";
  if (const std::string path = name + kPathDifference; is_number(metrics, path))
    words.errors += std::string(", other path ") + (metrics[path].number() < 0 ? "-" : "+") +
                    rounded_error(metric_error(path));
  if (const std::string mean = name + kDrawMean, error = name + kDrawMeanError;
      is_number(metrics, mean) && is_number(metrics, error))
    words.errors += ", mean of draws " + value_text(metrics[mean], metric_error(error), scale) + " ± " +
                    rounded_error(metric_error(error));
  words.value = value_text(metrics[name], largest, scale);
  return words;
}

}  // namespace

bool is_headline(const Metrics& metrics, const std::string& name) {
  return is_number(metrics, name) && std::ranges::any_of(kSources, [&](const auto& source) {
           return metrics.contains(name + source.first);
         });
}

std::string described_headline(const Metrics& metrics, const std::string& name) {
  for (const char* ending :
       {kStepError, kMeshError, kDrawError, kDrawMeanError, kDrawMean, kPathDifference}) {
    const std::string end = ending;
    if (!name.ends_with(end)) continue;
    const std::string headline = name.substr(0, name.size() - end.size());
    if (is_headline(metrics, headline)) return headline;
  }
  return "";
}

ShownQuantity with_rest_warning(ShownQuantity words, const Metrics& metrics, const std::string& name) {
  const bool is_ours = !name.starts_with("published_");
  if (is_ours && metrics["settled"].is(false)) words.errors = joined({words.errors, "(not at rest)"}, " ");
  return words;
}

ShownQuantity headline_text(const Metrics& metrics, const std::string& name) {
  ShownQuantity words = scaled_text(metrics, name, 1);
  words.unit = split_unit(name).unit;
  return with_rest_warning(std::move(words), metrics, name);
}

ShownQuantity headline_text(const Metrics& metrics, const Headline& headline) {
  ShownQuantity words;
  const std::string name = headline.metric, fitted = name + kStandardError;
  if (is_headline(metrics, name)) {
    words = scaled_text(metrics, name, headline.scale);
  } else if (is_number(metrics, fitted)) {
    const double error = headline.scale * std::abs(metrics[fitted].number());
    words = {value_text(metrics[name], error, headline.scale), "", "± " + rounded_error(error)};
  } else {
    words.value = fmt::format(fmt::runtime(headline.format), headline.scale * metrics[name].number());
  }
  words.unit = headline.unit;
  return with_rest_warning(std::move(words), metrics, name);
}

std::string with_errors(const Metrics& metrics, const std::string& name) {
  const auto [words, unit] = split_unit(name);
  const bool plain = !is_headline(metrics, name);
  return words + " " +
         (plain ? joined({number_text(metrics[name].number(), 4), unit}, " ")
                : headline_text(metrics, name).text());
}

}  // namespace hysteron::experiments
