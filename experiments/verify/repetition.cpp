#include "experiments/verify/repetition.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/diff/diff.h"
#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/pages/error_words.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kMinRoundOff = 1e-6;
constexpr double kSolverToleranceFraction = 0.1;  // times its tolerance

bool has_part(const std::string& name, const char* part) { return name.find(part) != name.npos; }

bool is_duration(const std::string& name) {
  return name.ends_with("setup_seconds") || name.ends_with("solve_s") || name.ends_with("computing_s") ||
         name.ends_with("ms_per_step");
}

// What --errors adds to a metric that the run has, and a repetition without it does not: an ending of its
// name.
bool is_error(const std::string& name, const Metrics& metrics) {
  for (const std::string ending :
       {kStepError, kMeshError, kDrawError, kDrawMean, kDrawMeanError, kPathDifference}) {
    if (!name.ends_with(ending)) continue;
    const std::string base = name.substr(0, name.size() - ending.size());
    const bool of_draws = ending == kDrawMean || ending == kDrawMeanError;
    if (metrics.contains(base) && (!of_draws || metrics.contains(base + kDrawError))) return true;
  }
  return false;
}

// The solver's work and what it left over, by their whole names; on a page behind a column's, "prandtl.".
bool is_effort(const std::string& name) {
  static const std::set<std::string> kNames = {"solver_iterations_per_step",
                                               "newton_iterations_per_step",
                                               "newton_residual_largest",
                                               "newton_velocity_largest_m_per_s",
                                               "newton_velocity_mean_m_per_s",
                                               "unbalanced_steps_count",
                                               "retried_steps_count",
                                               "deep_contact_steps_count",
                                               "slack_hand_steps_count",
                                               "barred_hand_steps_count",
                                               "energy_remainder_relative",
                                               "fastest_m_per_s",
                                               "strip_newton_iterations_per_step",
                                               "strip_retried_steps_count",
                                               "iterations"};
  return kNames.contains(name.substr(name.rfind('.') + 1));
}

// Metrics that are read off pictures.
bool is_drawn(const std::string& name) { return name == "shadow_drape_coefficient_percent"; }

// Of a metric, as the run itself has measured it; 0 where it has not.
double stated_error(const Metrics& metrics, const std::string& name) {
  double sum = 0;
  for (const char* cause : {"_step_error", "_mesh_error", "_draw_error"}) {
    const MetricValue& error = metrics[name + cause];
    if (error.is_number()) sum += std::abs(error.number());
  }
  return sum;
}

std::string metric_change(const std::string& name, double before, double now) {
  constexpr double kSmall = 1e-4;  // below, the digits that are printed are the same
  const double part = std::abs(now - before) / std::max(std::abs(before), std::abs(now));
  return part < kSmall ? fmt::format("{} by {:.1e} of itself", name, part)
                       : fmt::format("{} {:.6g} -> {:.6g}", name, before, now);
}

void compare_numbers(const std::string& name, double before, double now, std::optional<double> limit,
                     double error, bool counts, Repetition& repetition) {
  const double difference = std::abs(now - before);
  const double size = std::max(metric_scale(name, before), metric_scale(name, now));
  std::string words = metric_change(name, before, now);
  if (limit)
    words += fmt::format(" (limit {:.2g})", *limit);
  else if (error > 0)
    words += fmt::format(" (stated error {:.2g})", error);
  if (!limit && !counts && difference <= repetition.round_off * size)
    repetition.rounded.push_back(name);
  else
    (difference <= limit.value_or(error) ? repetition.within : repetition.beyond).push_back(words);
}

void compare_metric(const std::string& name, const Metrics& recorded, const MetricValue& now,
                    const Limits& limits, Repetition& repetition) {
  const MetricValue& before = recorded[name];
  ++repetition.metrics;
  if (before == now || (before.is_number() && now.is_number() && before.number() == now.number())) return;
  if (is_effort(name)) {
    repetition.effort.push_back(name);
  } else if (before.is_number() && now.is_number()) {
    compare_numbers(name, before.number(), now.number(), limits.of_metric(name), stated_error(recorded, name),
                    before.is_integer() && now.is_integer(), repetition);
  } else if (before.is_known() || now.is_known()) {
    repetition.beyond.push_back(name);
  }
}

// On the CPU the number of threads changes no bits.
std::string without_threads(const std::string& device) {
  return device.starts_with("cpu") ? device.substr(0, device.rfind(", ")) : device;
}

// Programs that did not note their compiler have recorded results with this one.
std::string compiler_of(const Manifest& run) { return run.compiler.empty() ? "g++ 12" : run.compiler; }

bool share_bits(const Manifest& recorded, const Manifest& now) {
  return !recorded.isa.empty() && recorded.isa == now.isa && compiler_of(recorded) == compiler_of(now) &&
         without_threads(recorded.device.value_or("")) == without_threads(now.device.value_or(""));
}

// What the repetition has found and the manifest does not hold.  Programs of later commits may measure more,
// but they hash the state and find the headlines that every program does.
void add_unrecorded(const Manifest& recorded, const Manifest& now, Repetition& repetition) {
  if (now.state_hash && !recorded.state_hash) repetition.unrecorded.push_back("the state");
  const std::vector<std::string>& requested = now.requested_metrics;
  const bool all_are_due = recorded.commit == now.commit || recorded.metrics.empty();
  for (const auto& [name, value] : now.metrics) {
    if (recorded.metrics.contains(name) || is_duration(name)) continue;
    const bool is_headline = std::count(requested.begin(), requested.end(), name) > 0 || is_asked_for(name);
    if (all_are_due || is_headline) repetition.unrecorded.push_back(name);
  }
}

Json without_origins(Json scene) {
  for (const char* key : {"threads", "device", "origin"}) scene.erase(key);
  if (scene.contains("fabric") && scene["fabric"].is_object()) scene["fabric"].erase("provenance");
  return scene;
}

}  // namespace

Agreement Repetition::agreement() const {
  if (!beyond.empty() || !pictures_beyond.empty() || !missing.empty() || !unrecorded.empty())
    return Agreement::none;
  if (same_state == has_state && rounded.empty() && effort.empty() && within.empty()) return Agreement::bits;
  return bits_are_due ? Agreement::none : Agreement::errors;
}

double round_off_bound(const Manifest& run) {
  const std::string integrator = run.text("integrator");
  if (integrator.empty() || integrator == "explicit") return kMinRoundOff;
  const double tolerance = run.number(integrator == "semi-implicit" ? "solver-tolerance" : "newton-residual");
  return std::max(kMinRoundOff, kSolverToleranceFraction * tolerance);
}

double metric_scale(const std::string& name, double number) {
  double whole = 0;
  if (name.ends_with("_percent")) whole = 100;
  if (name.ends_with("_relative") || has_part(name, "_over_")) whole = 1;
  if (name.ends_with("_deg")) whole = 180;
  if (has_part(name, "curvature") && name.ends_with("_per_m")) whole = 1;
  return std::max(std::abs(number), whole);
}

Repetition compare_runs(const Manifest& recorded, const Manifest& now, const Limits& limits, bool exact) {
  Repetition repetition;
  repetition.has_state = recorded.state_hash.has_value();
  repetition.same_state = repetition.has_state && recorded.state_hash == now.state_hash;
  if (repetition.has_state && !now.state_hash) repetition.missing.push_back("the state");
  repetition.bits_are_due = exact || share_bits(recorded, now);
  repetition.round_off = round_off_bound(recorded);
  const bool drawn = !now.renderer.value_or("").empty();
  for (const auto& [name, value] : recorded.metrics) {
    if (is_duration(name) || is_error(name, recorded.metrics)) continue;
    if (now.metrics.contains(name))
      compare_metric(name, recorded.metrics, now.metrics[name], limits, repetition);
    else if (drawn || !is_drawn(name))
      repetition.missing.push_back(name);
  }
  add_unrecorded(recorded, now, repetition);
  return repetition;
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
                      const Limits& limits, Repetition& repetition) {
  std::error_code ignored;
  for (const std::string& name : names) {
    if (!fs::is_regular_file(now / name, ignored)) {
      repetition.pictures_beyond.push_back(name + " is not drawn any more");
      continue;
    }
    ++repetition.pictures;
    try {
      const Measures found = compare_files(recorded / name, now / name, {}).measures;
      const std::vector<std::string> broken = broken_limits(found, limits.of_picture(name));
      if (!broken.empty()) repetition.pictures_beyond.push_back(name + ": " + join(broken, ", "));
    } catch (const Error& error) {
      repetition.pictures_beyond.push_back(name + ": " + error.what());
    }
  }
}

std::string reasons_between(const Manifest& recorded, const Manifest& now) {
  std::vector<std::string> reasons;
  if (recorded.commit != now.commit || recorded.dirty || now.dirty)
    reasons.push_back("program " + recorded.commit.substr(0, 7) + (recorded.dirty ? " (modified)" : "") +
                      ", now " + now.commit.substr(0, 7) + (now.dirty ? " (modified)" : ""));
  if (recorded.isa != now.isa)
    reasons.push_back("instructions " + (recorded.isa.empty() ? "not noted" : recorded.isa) + ", now " +
                      now.isa);
  if (compiler_of(recorded) != compiler_of(now))
    reasons.push_back("compiler " + compiler_of(recorded) + ", now " + compiler_of(now));
  if (recorded.device != now.device)
    reasons.push_back("device " + recorded.device.value_or("none") + ", now " + now.device.value_or("none"));
  const std::string keys = differing_keys(without_origins(*recorded.keys), without_origins(*now.keys));
  if (!keys.empty()) reasons.push_back("keys " + keys);
  for (const std::string& change : changed_meshes(recorded.meshes, now.meshes)) reasons.push_back(change);
  return join(reasons, "; ");
}

}  // namespace hysteron::experiments
