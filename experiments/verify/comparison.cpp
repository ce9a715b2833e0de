#include "experiments/verify/comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/workbench/session/checkpoint.h"
#include "render/compare.h"
#include "render/image.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kMostMean = 0.2, kMostOver8 = 0.3;  // as tests/golden/scenes.sh

bool is_duration(const std::string& name) {
  return name.ends_with("setup_seconds") || name.ends_with("solve_s") || name.ends_with("computing_s") ||
         name.ends_with("ms_per_step");
}

bool is_error(const std::string& name) {
  return name.ends_with("_error") || name.ends_with("_stderr") || name.find("_draw_") != name.npos;
}

// Of a metric, as the run itself has measured it; 0 where it has not.
double stated_error(const Metrics& metrics, const std::string& name) {
  double sum = 0;
  for (const char* cause : {"_step_error", "_mesh_error", "_draw_error"}) {
    const MetricValue& error = metrics[name + cause];
    if (error.is_number()) sum += std::abs(error.number());
  }
  return sum;
}

void compare_metric(const std::string& name, const MetricValue& before, const MetricValue& now, double error,
                    Comparison& comparison) {
  ++comparison.metrics;
  if (before == now || (before.is_number() && now.is_number() && before.number() == now.number())) return;
  if (!before.is_number() || !now.is_number()) {
    if (before.is_known() || now.is_known()) comparison.beyond.push_back(name);
    return;
  }
  const double difference = now.number() - before.number();
  constexpr double kSmall = 1e-4;  // below, the digits that are printed are the same
  const double part = std::abs(difference) / std::max(std::abs(before.number()), std::abs(now.number()));
  std::string words = part < kSmall ? fmt::format("{} by {:.1e} of itself", name, part)
                                    : fmt::format("{} {:.6g} -> {:.6g}", name, before.number(), now.number());
  if (error > 0) words += fmt::format(" (stated error {:.2g})", error);
  (std::abs(difference) <= error ? comparison.within : comparison.beyond).push_back(words);
}

Json without_origins(Json scene) {
  for (const char* key : {"threads", "device", "origin"}) scene.erase(key);
  if (scene.contains("fabric") && scene["fabric"].is_object()) scene["fabric"].erase("provenance");
  return scene;
}

}  // namespace

Comparison compare_runs(const Manifest& recorded, const Manifest& now) {
  Comparison comparison;
  comparison.has_state = recorded.state_hash.has_value();
  comparison.same_state = comparison.has_state && recorded.state_hash == now.state_hash;
  for (const auto& [name, value] : recorded.metrics) {
    if (is_duration(name) || is_error(name)) continue;
    if (!now.metrics.contains(name)) {
      comparison.missing.push_back(name);
      continue;
    }
    compare_metric(name, value, now.metrics[name], stated_error(recorded.metrics, name), comparison);
  }
  return comparison;
}

std::vector<std::string> pictures_in(const Manifest& recorded, const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const std::string& name : recorded.files)
    if (name.ends_with(".png") && !name.starts_with("plot_") && fs::is_regular_file(folder / name, ignored))
      names.push_back(name);
  return names;
}

void compare_pictures(const std::vector<std::string>& names, const fs::path& recorded, const fs::path& now,
                      Comparison& comparison) {
  std::error_code ignored;
  for (const std::string& name : names) {
    if (!fs::is_regular_file(now / name, ignored)) {
      comparison.pictures_beyond.push_back(name + " is not drawn any more");
      continue;
    }
    ++comparison.pictures;
    try {
      const render::Difference d =
          render::compare(render::read_png(recorded / name), render::read_png(now / name));
      if (d.mean_abs > kMostMean || d.pixels_over_8_percent > kMostOver8)
        comparison.pictures_beyond.push_back(
            fmt::format("{} by {:.3g} of 255 on the mean, {:.3g} % of its pixels by more than 8", name,
                        d.mean_abs, d.pixels_over_8_percent));
    } catch (const Error& error) {
      comparison.pictures_beyond.push_back(name + ": " + error.what());
    }
  }
}

std::string reasons_between(const Manifest& recorded, const Manifest& now) {
  std::vector<std::string> reasons;
  if (recorded.commit != now.commit || recorded.dirty || now.dirty)
    reasons.push_back("program " + recorded.commit.substr(0, 7) + (recorded.dirty ? " (modified)" : "") +
                      ", now " + now.commit.substr(0, 7) + (now.dirty ? " (modified)" : ""));
  if (recorded.device != now.device)
    reasons.push_back("device " + recorded.device.value_or("none") + ", now " + now.device.value_or("none"));
  const std::string keys =
      differing_keys(without_origins(*recorded.keys).dump(), without_origins(*now.keys).dump());
  if (!keys.empty()) reasons.push_back("keys " + keys);
  return join(reasons, "; ");
}

}  // namespace hysteron::experiments
