#include "experiments/verify/repetition.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/diff/diff.h"
#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/same_request.h"
#include "experiments/workbench/pages/error_notes.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kMinRoundOff = 1e-6;
constexpr double kSolverToleranceFraction = 0.1;  // share of the solver's tolerance

// True for metrics that --errors adds to a metric of the run, by their ending; a repetition without --errors
// lacks them.
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

// True for metrics that are read off pictures.
bool is_drawn(const std::string& name) { return name == "shadow_drape_coefficient_percent"; }

void compare_metric(const std::string& name, const Metrics& recorded, const MetricValue& now,
                    const Limits& limits, Repetition& repetition) {
  const MetricValue& before = recorded[name];
  ComparedNumbers& found = repetition.metrics;
  ++found.count;
  if (before == now || (before.is_number() && now.is_number() && before.number() == now.number())) return;
  const std::optional<double> limit = limits.of_metric(name);
  if (!limit && is_effort(name)) {
    found.effort.push_back(name);
  } else if (before.is_number() && now.is_number()) {
    const double size = std::max(metric_scale(name, before.number()), metric_scale(name, now.number()));
    compare_numbers({.name = name,
                     .before = before.number(),
                     .now = now.number(),
                     .round_off = repetition.round_off * size,
                     .limit = limit,
                     .stated_error = stated_error(recorded, name),
                     .counts = before.is_integer() && now.is_integer()},
                    found);
  } else if (before.is_known() || now.is_known()) {
    found.beyond.push_back(name);
  }
}

using EnergyTerms = std::vector<std::pair<std::string, double>>;

const double* find_term(const EnergyTerms& terms, const std::string& name) {
  const auto found = std::ranges::find(terms, name, [](const auto& term) { return term.first; });
  return found == terms.end() ? nullptr : &found->second;
}

// Compares the terms of a balance, which share the round-off of the largest.
void compare_energies(const Manifest& recorded, const Manifest& now, const Limits& limits,
                      Repetition& repetition) {
  double largest = 0;
  for (const EnergyTerms* terms : {&recorded.energy, &now.energy})
    for (const auto& [name, joules] : *terms) largest = std::max(largest, std::abs(joules));
  for (const auto& [name, before] : recorded.energy) {
    const double* const joules = find_term(now.energy, name);
    if (joules == nullptr) {
      repetition.missing.push_back(energy_name(name));
      continue;
    }
    ++repetition.energies.count;
    if (*joules == before) continue;
    const std::optional<double> limit = limits.of_metric(energy_name(name));
    if (!limit && is_effort(name))
      repetition.energies.effort.push_back(energy_name(name));
    else
      compare_numbers({.name = energy_name(name),
                       .before = before,
                       .now = *joules,
                       .round_off = repetition.round_off * largest,
                       .limit = limit},
                      repetition.energies);
  }
  if (recorded.energy.empty() && !now.energy.empty()) repetition.unrecorded.push_back("the energy balance");
  if (recorded.energy.empty() || recorded.commit != now.commit) return;
  for (const auto& [name, joules] : now.energy)
    if (find_term(recorded.energy, name) == nullptr) repetition.unrecorded.push_back(energy_name(name));
}

// True for tables that a repetition does not reproduce: it runs without --errors, and the cheapest settings
// of `accuracy` are chosen by durations.
bool is_table_of_one_run(const std::string& file) { return file == "errors.csv" || file == "cheapest.csv"; }

bool is_table(const std::string& file) { return file.ends_with(".csv") && !is_table_of_one_run(file); }

bool is_data(const std::string& file) {
  return file.ends_with(".toml") || file.ends_with(".ply") || file.ends_with(".obj");
}

bool is_compared_file(const std::string& file, bool with_pictures) {
  return is_table(file) || is_table_of_one_run(file) || is_data(file) || (with_pictures && is_picture(file));
}

// Returns the device without the number of threads, which on the CPU changes no bits.
std::string without_threads(const std::string& device) {
  return device.starts_with("cpu") ? device.substr(0, device.rfind(", ")) : device;
}

// Returns the compiler; programs that did not note it have recorded results with this one.
std::string compiler_of(const Manifest& run) { return run.compiler.empty() ? "g++ 12" : run.compiler; }

bool share_bits(const Manifest& recorded, const Manifest& now) {
  return !recorded.isa.empty() && recorded.isa == now.isa && compiler_of(recorded) == compiler_of(now) &&
         without_threads(recorded.device.value_or("")) == without_threads(now.device.value_or(""));
}

// Records what the repetition has and the manifest lacks.  Programs of later commits may measure more, but
// every program hashes the state and has the headlines.
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
  for (const KeyDescription& key : scene_keys())
    if (key.traits.scope == Scope::run) scene.erase(key.path);
  scene.erase("origin");
  if (scene.contains("fabric") && scene["fabric"].is_object()) scene["fabric"].erase("provenance");
  return scene;
}

}  // namespace

bool is_picture(const std::string& file) { return file.ends_with(".png") && !file.starts_with("plot_"); }

bool is_compared(const std::string& metric, const Metrics& metrics) {
  return !is_duration(metric) && !is_error(metric, metrics);
}

std::string energy_name(const std::string& term) { return "energy." + term; }

Agreement Repetition::agreement() const {
  for (const ComparedNumbers* numbers : {&metrics, &energies, &series})
    if (!numbers->beyond.empty()) return Agreement::none;
  if (!pictures_beyond.empty() || !data_beyond.empty() || !missing.empty() || !unrecorded.empty() ||
      !lost.empty() || !edited.empty())
    return Agreement::none;
  if (same_state == has_state && metrics.all_same() && energies.all_same() && series.all_same())
    return Agreement::bits;
  return bits_are_due ? Agreement::none : Agreement::errors;
}

double round_off_bound(const Manifest& run) {
  const std::string integrator = run.text("integrator");
  if (integrator.empty() || integrator == "explicit") return kMinRoundOff;
  const double tolerance = run.number(integrator == "semi-implicit" ? "solver-tolerance" : "newton-residual");
  return std::max(kMinRoundOff, kSolverToleranceFraction * tolerance);
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
    if (!is_compared(name, recorded.metrics)) continue;
    if (now.metrics.contains(name))
      compare_metric(name, recorded.metrics, now.metrics[name], limits, repetition);
    else if (drawn || !is_drawn(name))
      repetition.missing.push_back(name);
  }
  compare_energies(recorded, now, limits, repetition);
  add_unrecorded(recorded, now, repetition);
  return repetition;
}

ComparableFiles comparable_files(const Manifest& recorded, const fs::path& folder, bool with_pictures) {
  const auto is_there = [&](const std::string& name) {
    std::error_code ignored;
    return fs::is_regular_file(folder / name, ignored);
  };
  constexpr const char* kPage = "report.html";
  const bool is_whole = std::ranges::find(recorded.files, kPage) == recorded.files.end() || is_there(kPage);
  ComparableFiles files;
  for (const std::string& name : recorded.files) {
    if (!is_compared_file(name, with_pictures)) continue;
    if (!is_there(name)) {
      if (is_whole)
        files.lost.push_back(name);
      else
        ++files.trimmed;
    } else if (is_table_of_one_run(name)) {
      if (!is_as_written(recorded, folder, name)) files.edited.push_back(name);
    } else {
      (is_table(name) ? files.tables : is_data(name) ? files.data : files.pictures).push_back(name);
    }
  }
  return files;
}

void add_unlisted_files(const Manifest& recorded, const Manifest& now, bool with_pictures,
                        Repetition& repetition) {
  if (recorded.commit != now.commit) return;
  for (const std::string& name : now.files)
    if (is_compared_file(name, with_pictures) &&
        std::ranges::find(recorded.files, name) == recorded.files.end())
      repetition.unrecorded.push_back(name);
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

void compare_data(const std::vector<std::string>& names, const fs::path& recorded, const fs::path& now,
                  bool same_program, Repetition& repetition) {
  std::error_code ignored;
  for (const std::string& name : names) {
    if (!fs::is_regular_file(now / name, ignored)) {
      repetition.data_beyond.push_back(name + " is not written any more");
      continue;
    }
    ++repetition.data_files;
    const auto bytes = [&](const fs::path& folder) { return whole_file(folder / name); };
    if (bytes(recorded) == bytes(now)) continue;
    if (same_program && repetition.bits_are_due)
      repetition.data_beyond.push_back(name);
    else
      repetition.data_otherwise.push_back(name);
  }
}

std::string reasons_between(const Manifest& recorded, const Manifest& now) {
  std::vector<std::string> reasons;
  const bool same_build = !recorded.build.empty() && recorded.build == now.build;
  if (recorded.commit != now.commit || (!same_build && (recorded.dirty || now.dirty)))
    reasons.push_back("program " + recorded.commit.substr(0, 7) + (recorded.dirty ? " (modified)" : "") +
                      ", now " + now.commit.substr(0, 7) + (now.dirty ? " (modified)" : ""));
  if (recorded.isa != now.isa)
    reasons.push_back("instructions " + (recorded.isa.empty() ? "not noted" : recorded.isa) + ", now " +
                      now.isa);
  if (compiler_of(recorded) != compiler_of(now))
    reasons.push_back("compiler " + compiler_of(recorded) + ", now " + compiler_of(now));
  const std::string device = without_threads(recorded.device.value_or("none")),
                    device_now = without_threads(now.device.value_or("none"));
  if (device != device_now) reasons.push_back("device " + device + ", now " + device_now);
  const std::string keys = differing_keys(without_origins(*recorded.keys), without_origins(*now.keys));
  if (!keys.empty()) reasons.push_back("keys " + keys);
  for (const std::string& change : changed_meshes(recorded.meshes, now.meshes)) reasons.push_back(change);
  return join(reasons, "; ");
}

}  // namespace hysteron::experiments
