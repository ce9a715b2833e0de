#include "experiments/workbench/compare/errors.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/app/integrator_texts.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/pages/error_notes.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/mesh_files.h"

namespace hysteron::experiments {
namespace {

constexpr int kFiner = 4;  // factor of the triangles
constexpr std::size_t kDrawsForAMean = 3;
constexpr char kHalfTheStep[] = "step";  // name of the repeat

// Returns the other structured families; those for a tube close at its seam.
std::vector<MeshFamily> other_families(const Scene& scene) {
  const auto own = value_if_named<MeshFamily>(scene.mesh);
  if (own == MeshFamily::random) return {};
  const bool is_tube = scene.cloth.shape == ClothOutline::tube;
  std::vector<MeshFamily> families = {MeshFamily::unionjack,
                                      is_tube ? MeshFamily::flipped : MeshFamily::equilateral};
  std::erase_if(families, [&](MeshFamily family) { return own == family; });
  return families;
}

// Returns the changes of draw 1, 2 ...: other families first, then random meshes of other seeds.
std::vector<Flag> resampled_mesh(const Scene& scene, int mesh_sample) {
  const std::vector<MeshFamily> families = other_families(scene);
  const int random = mesh_sample - static_cast<int>(families.size());
  if (random <= 0) return {{"mesh", enum_name(families[static_cast<std::size_t>(mesh_sample) - 1])}};
  return {{"mesh", enum_name(MeshFamily::random)}, {"seed", scene.seed + static_cast<unsigned>(random)}};
}

// Returns the changes of draw 1, 2 ...: 3/2, 2/3, 2, 1/2 ... times the triangles.
std::vector<Flag> resized_mesh(const Scene& scene, int mesh_sample) {
  const int halves = 2 + (mesh_sample + 1) / 2;
  const int number = mesh_sample % 2 ? scene.triangles / 2 * halves : scene.triangles * 2 / halves;
  return {{"triangles", number}};
}

bool from_a_file(const Scene& scene) { return !rest_file(scene).empty(); }

Flag finer_mesh(const Scene& scene) {
  if (from_a_file(scene)) return {kSubdivisions, scene.cloth.subdivisions + 1};
  return {"triangles", kFiner * scene.triangles};
}

ChildRun child_run(const Run& run, const CommandLine& line, const ErrorRun& error_run) {
  std::vector<Flag> own = error_run.changes;
  // These flags override the scene's file.
  const Flag no_images = {"no-images", true};
  own.push_back(no_images);
  for (const KeyDescription& key : simulation_keys())
    if (!key.traits.repeats)
      own.push_back({key.flag(), key.type == "flag" ? Value(false) : parse_text(key, key.default_text)});
  CommandLine once = line;
  for (const Flag& change : error_run.changes)
    if (change.path == experiment_headlines(line.experiment).release)
      once.flags = without_unread_flags(once, change);
  once.flags = without_unread_flags(once, no_images);
  std::erase_if(once.flags, [](const Flag& flag) { return flag.path.starts_with("errors"); });
  return child_run(error_run.name, once, own, run.folder() / "errors");
}

// Returns how the run's cloth was let go, from what it recorded: "drape.release" is `release` of "drape".
std::string noted_release(const Run& run, const Headlines& headlines) {
  const std::size_t dot = headlines.release.find('.');
  if (dot == std::string::npos) return "";
  for (const auto& [key, value] : run.manifest().own)
    if (key == headlines.release.substr(0, dot)) return value->at(headlines.release.substr(dot + 1));
  return "";
}

// Returns "step=0.0005 seed=2", with `before` before each.
std::string changes_text(const std::vector<Flag>& flags, const std::string& before) {
  std::string text;
  for (const Flag& flag : flags) text += (text.empty() ? "" : " ") + before + flag.path + "=" + flag.text();
  return text;
}

// True if it ended in the run's own state.
bool is_unchanged(const ChildRun& column, const Run& run) {
  return column.manifest && column.manifest->state_hash &&
         column.manifest->state_hash == run.manifest().state_hash;
}

bool is_of_integrator(const std::string& text) { return text.starts_with(kIntegrator); }

// Returns what the integrator took, negative if it gave, over what else was dissipated.
double integrator_part(const Manifest& manifest) {
  double taken = 0;  // [J]
  for (const auto& [name, joules] : manifest.energy)
    if (name.starts_with("integrator_")) taken += joules;
  const double share = manifest.metrics["integrator_share_percent"].number() / 100;
  return std::copysign(share / (1 - share), taken);
}

// Warns of what the columns report beyond the run's own warnings.  Where the run warns of its integrator,
// half the step tells what shorter ones would change, and the other repeats' estimates are left out.
void warn_about_columns(const std::vector<ChildRun>& columns, Run& run) {
  ColumnWarnings warnings;
  const std::vector<std::string>& own = run.manifest().warnings;
  const bool warns_of_integrator = std::any_of(own.begin(), own.end(), is_of_integrator);
  for (const ChildRun& column : columns) {
    if (!column.manifest) continue;
    std::vector<std::string> texts = column.manifest->warnings;
    std::erase_if(texts, [&](const std::string& text) {
      return std::count(own.begin(), own.end(), text) > 0 || (warns_of_integrator && is_of_integrator(text));
    });
    if (warns_of_integrator && column.name == kHalfTheStep &&
        column.metrics()["integrator_share_percent"].is_number())
      texts.push_back(integrator_text(integrator_part(run.manifest()), integrator_part(*column.manifest),
                                      run.manifest().number("step")));
    warnings.add("errors, " + column.name, texts);
  }
  warnings.emit(run);
}

// Writes errors.csv with a row for each repeat.
void write_table(Run& run, const std::vector<std::string>& metrics, const std::vector<ErrorRun>& error_runs,
                 const std::vector<ChildRun>& columns) {
  std::vector<std::string> head = {"repeat", "differs"};
  head.insert(head.end(), metrics.begin(), metrics.end());
  head.insert(head.end(), {"wall_s", "complete", "stopped"});
  Table table(head);
  for (std::size_t i = 0; i < error_runs.size(); ++i) {
    const Metrics found = columns[i].metrics();
    std::vector<Cell> fields = {error_runs[i].name, changes_text(error_runs[i].changes, "")};
    for (const std::string& name : metrics) {
      const MetricValue& value = found[name];
      fields.push_back(value.is_number() ? number_text(value.number()) : "");
    }
    const std::optional<double> seconds =
        columns[i].manifest ? columns[i].manifest->own_seconds() : std::nullopt;
    fields.push_back(seconds ? Cell(*seconds) : Cell(""));
    fields.push_back(columns[i].stopped.empty());
    fields.push_back(columns[i].stopped);
    table.row(fields);
  }
  table.write(run.path("errors.csv"));
}

// Tightens the tolerance of adaptive steps, too: the error that they keep is of third order, with `implicit`
// of second.
std::vector<Flag> half_the_step(const Scene& scene) {
  std::vector<Flag> changes = {{"step", scene.step / 2}};
  if (scene.tolerance > 0)
    changes.push_back({"tolerance", scene.tolerance / (scene.integrator == Integrator::implicit ? 4 : 8)});
  return changes;
}

// Estimates the errors of a run from the metrics of its repeats.
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
      single(name, kHalfTheStep, kStepError);
      single(name, "mesh", kMeshError);
      mesh_samples(name);
      path(name);
    }
    return std::move(errors_);
  }

 private:
  // True if a repeat reproduces every bit, because its change had no effect and shows no error.  Two paths
  // may be the same.
  static bool unused(const ErrorRunResult& r) { return r.unchanged && r.error_run.name != "path"; }

  bool is_usable(const ErrorRunResult& r) {
    const std::string what = r.error_run.name + " (" + changes_text(r.error_run.changes, "--") + ")";
    if (!r.stopped.empty())
      errors_.missing.push_back(what + " is not complete: " + r.stopped);
    else if (unused(r))
      errors_.missing.push_back(what + " changes no bit of the run, so it says nothing of an error");
    return r.stopped.empty() && !unused(r);
  }

  // Returns the headline's values in the repeats of that name, "draw-2" being a "draw".
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
    mean /= n;  // the mean of equal counts is exactly that count
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

std::vector<ErrorRun> planned_error_runs(const std::string& experiment, const Scene& scene,
                                         const std::string& release, int mesh_samples) {
  const Headlines& headlines = experiment_headlines(experiment);
  std::vector<ErrorRun> error_runs;
  const bool drawn = !from_a_file(scene);
  // The longest runs come first, because they run side by side.
  error_runs.push_back({"mesh", {finer_mesh(scene)}});
  if (!headlines.equilibria) error_runs.push_back({kHalfTheStep, half_the_step(scene)});
  for (int mesh_sample = 1; drawn && mesh_sample <= mesh_samples; ++mesh_sample)
    error_runs.push_back({"draw-" + std::to_string(mesh_sample), headlines.own_mesh
                                                                     ? resized_mesh(scene, mesh_sample)
                                                                     : resampled_mesh(scene, mesh_sample)});
  const auto other = std::find_if(headlines.paths.begin(), headlines.paths.end(),
                                  [&](const std::string& path) { return path != release; });
  if (other != headlines.paths.end()) error_runs.push_back({"path", {{headlines.release, *other}}});
  return error_runs;
}

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

void measure_errors(Run& run, const CommandLine& line, const Setup& setup) {
  const auto stage = run.stage("errors");
  run.keep();
  const Headlines& headlines = experiment_headlines(line.experiment);
  std::vector<std::string> names = headlines.with_errors();
  names.insert(names.end(), setup.requested_metrics.begin(), setup.requested_metrics.end());
  const std::vector<ErrorRun> error_runs = planned_error_runs(
      line.experiment, setup.scene, noted_release(run, headlines), setup.options.errors_draws);
  std::vector<ChildRun> columns;
  for (const ErrorRun& error_run : error_runs) {
    columns.push_back(child_run(run, line, error_run));
    run.add_part(columns.back().folder, false);
  }
  SweepJobs jobs;
  jobs.at_once = setup.options.errors_jobs;
  jobs.batch = setup.options.errors_batch;
  jobs.cores = setup.scene.threads;
  jobs.gpu = setup.scene.device != DeviceChoice::cpu;
  jobs.tolerates_failures = true;
  run_columns(
      columns, jobs,
      [&](const ChildRun& column) { run.progress("errors, " + column.name + ": " + run_outcome(column)); },
      [&](const std::string& line) { run.progress("errors: " + line); });
  warn_about_columns(columns, run);
  write_table(run, names, error_runs, columns);
  std::vector<ErrorRunResult> found;
  for (std::size_t i = 0; i < error_runs.size(); ++i)
    found.push_back({error_runs[i], columns[i].metrics(), columns[i].stopped, is_unchanged(columns[i], run)});
  const Errors errors = estimated_errors(line.experiment, run.metrics(), found, setup.requested_metrics);
  for (const auto& [name, value] : errors.metrics) run.metric(name, value);
  run.manifest().errors_missing = errors.missing;
  for (const std::string& name : names)
    if (is_headline(run.metrics(), name)) run.progress(with_errors(run.metrics(), name));
  for (const std::string& sentence : errors.missing) run.warn("errors: " + sentence);
}

}  // namespace hysteron::experiments
