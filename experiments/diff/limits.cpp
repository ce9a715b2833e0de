#include "experiments/diff/limits.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/toml_file.h"

namespace hysteron::experiments {
namespace {

using M = Measures;
// clang-format off
const KeyRow<Measures> kLimitRows[] = {
    {"max-mean", at<&M::mean_abs>, "8-bit steps", at_least(0), "most of mean_abs"},
    {"max-rmse", at<&M::rmse>, "8-bit steps", at_least(0), "most of rmse"},
    {"min-psnr", at<&M::psnr_db>, "dB", any(), "least of psnr_db"},
    {"min-ssim", at<&M::ssim>, "", between(-1, 1), "least of ssim"},
    {"max-flip", at<&M::flip>, "", between(0, 1), "most of flip"},
    {"max-pixels-over-8", at<&M::pixels_over_8_percent>, "percent", between(0, 100), "most of pixels_over_8_percent"},
};

struct MetricLimit {
  std::string name;
  double max_difference = 0;
};
const KeyRow<MetricLimit> kMetricRows[] = {
    {"name", at<&MetricLimit::name>, "", any(), "of the metric"},
    {"max-difference", at<&MetricLimit::max_difference>, "", at_least(0), "in the metric's unit"},
};
// clang-format on

// Escapes brackets, because a column's unit, "metrics.csv:tip [m]", is no character class.
bool matches(const std::string& pattern, const std::string& name) {
  std::string literal;
  for (const char c : pattern) literal += c == '[' ? "\\[" : std::string(1, c);
  return fnmatch(literal.c_str(), name.c_str(), 0) == 0;
}

class LimitsFile {
 public:
  explicit LimitsFile(std::string file) : file_(std::move(file)) {}

  Limits read() const {
    Limits limits;
    for (const ValueTree& node : read_toml(file_).children) {
      if (node.key == "picture")
        for (const ValueTree& table : tables(node, file_)) limits.pictures.push_back(picture(table));
      else if (node.key == "metric")
        for (const ValueTree& table : tables(node, file_)) {
          limits.metrics.push_back(metric(table));
          limits.metric_tables.push_back(place(file_, table));
        }
      else
        read_limit(node, limits.all);
    }
    return limits;
  }

 private:
  void read_limit(const ValueTree& node, PictureLimits& limits) const {
    assign(bind_limits(limits.values), node, file_);
    limits.places[node.key] = place(file_, node);
  }

  std::pair<std::string, PictureLimits> picture(const ValueTree& table) const {
    PictureLimits limits;
    limits.table = place(file_, table);
    for (const ValueTree& node : table.children)
      if (node.key != "name") read_limit(node, limits);
    return {limit_name(table), limits};
  }

  std::pair<std::string, double> metric(const ValueTree& table) const {
    MetricLimit limit;
    const Keys keys = bind(kMetricRows, limit);
    for (const ValueTree& node : table.children) assign(keys, node, file_);
    if (!table.find("max-difference"))
      throw Error::invalid_input("the limit of a metric needs max-difference")
          .with_origin(place(file_, table));
    return {limit_name(table), limit.max_difference};
  }

  std::string limit_name(const ValueTree& table) const {
    const ValueTree* node = table.find("name");
    const auto* name = node ? std::get_if<std::string>(&node->value) : nullptr;
    if (!name || name->empty())
      throw Error::invalid_input("a limit needs a name, in which * stands for any text")
          .with_origin(place(file_, node ? *node : table));
    return *name;
  }

  std::string file_;
};

}  // namespace

Keys bind_limits(Measures& limits) { return bind(kLimitRows, limits); }

void PictureLimits::set(const PictureLimits& over) {
  for (const Measure& m : all_measures()) {
    if (std::isinf(over.values.*m.value)) continue;
    values.*m.value = over.values.*m.value;
    const auto place = over.places.find(m.limit);
    place == over.places.end() ? void(places.erase(m.limit)) : void(places[m.limit] = place->second);
  }
}

bool PictureLimits::has_any() const {
  return std::ranges::any_of(all_measures(), [&](const Measure& m) { return !std::isinf(values.*m.value); });
}

std::vector<std::string> broken_limits(const Measures& found, const PictureLimits& limits) {
  std::vector<std::string> broken;
  for (const Measure& m : all_measures()) {
    const double value = found.*m.value, limit = limits.values.*m.value;
    if (m.least ? value >= limit : value <= limit) continue;
    const auto place = limits.places.find(m.limit);
    broken.push_back(std::string(m.name) + " = " + number_field(value) + " must be " +
                     (m.least ? ">= " : "<= ") + number_field(limit) + " (" +
                     (place == limits.places.end() ? std::string("--") + m.limit : place->second) + ")");
  }
  return broken;
}

PictureLimits Limits::of_picture(const std::string& name) const {
  PictureLimits limits = all;
  for (const auto& [pattern, own] : pictures)
    if (matches(pattern, name)) limits.set(own);
  return limits;
}

std::optional<double> Limits::of_metric(const std::string& name) const {
  std::optional<double> limit;
  for (const auto& [pattern, most] : metrics)
    if (matches(pattern, name)) limit = most;
  return limit;
}

namespace {

bool matches_any(const std::string& pattern, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) { return matches(pattern, name); });
}

void refuse_unused(const std::string& pattern, const std::vector<std::string>& names,
                   const NotCompared& others, const std::string& kind, const std::string& place) {
  if (matches_any(pattern, names)) return;
  const std::string why = matches_any(pattern, others.names)
                              ? ", which is not compared: " + others.why
                              : ", and none is called so" + suggestion(pattern, names);
  throw Error::invalid_input("a limit is for the " + kind + " " + pattern + why)
      .with_origin(place)
      .with_key("name", pattern);
}

}  // namespace

bool Limits::has_pictures() const {
  return all.has_any() || std::ranges::any_of(pictures, [](const auto& own) { return own.second.has_any(); });
}

void Limits::refuse_unused_pictures(const std::vector<std::string>& names, const NotCompared& others) const {
  for (const auto& [pattern, own] : pictures) refuse_unused(pattern, names, others, "picture", own.table);
}

void Limits::refuse_unused_metrics(const std::vector<std::string>& names, const NotCompared& others) const {
  for (std::size_t i = 0; i < metrics.size(); ++i)
    refuse_unused(metrics[i].first, names, others, "metric", metric_tables.at(i));
}

Limits read_limits(const std::string& name_or_file) {
  return LimitsFile(find_asset("limits", name_or_file, "--limits").string()).read();
}

}  // namespace hysteron::experiments
