#include "experiments/workbench/app/run.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/same_request.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/app/this_program.h"
#include "render/plot.h"
#include "sim/base/archive.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/time/together.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

const char* const kStages[] = {"membrane", "bending", "solve",  "contact",
                               "history",  "render",  "encode", "io"};

constexpr const char* kPlotEndings[] = {".png", ".svg", ".pdf"};

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// Returns a manifest with what is known at the start.
Manifest first_entries(const CommandLine& line, const Json& scene) {
  const auto text = [&](const char* key) {
    return scene.contains(key) && scene[key].is_string() ? std::optional(scene[key].get<std::string>())
                                                         : std::nullopt;
  };
  Manifest manifest = this_program();
  manifest.experiment = line.experiment;
  manifest.command = line.command;
  manifest.spec = RunSpec{line.positionals};
  for (const Flag& flag : line.flags) manifest.spec->flags.emplace_back(flag.path, flag.text());
  manifest.started = utc_now();
  manifest.keys = std::make_shared<const Json>(scene);
  manifest.precision = text("precision");
  manifest.element = text("element");
  manifest.law = text("law");
  if (jobs_together() > 1) manifest.batch = jobs_together();
  return manifest;
}

fs::path folder_of(const CommandLine& line, const Options& options) {
  return options.out.empty() ? "out/" + line.experiment : options.out;
}

// Returns a manifest with all that --resume needs of a run that is interrupted as soon as it has begun.
Manifest first_entries(const CommandLine& line, const Setup& setup) {
  Manifest manifest = first_entries(line, to_json(setup.scene));
  manifest.options = setup.resolved;
  manifest.requested_metrics = setup.requested_metrics;
  manifest.meshes = mesh_records(setup.scene);
  if (setup.requested)
    manifest.requested =
        std::make_shared<const Json>(requested_patch(*manifest.keys, to_json(*setup.requested)));
  return manifest;
}

}  // namespace

Run::Run(const CommandLine& line, const Setup& setup, const std::vector<std::string>& kept)
    : Run(first_entries(line, setup), line, setup.options, kept) {
  for (const std::string& change : changed_meshes(setup.recorded_meshes, manifest_.meshes)) warn(change);
}

Run::Run(const CommandLine& line, const Options& options, const Json& keys)
    : Run(first_entries(line, keys), line, options, {}) {}

Run::Run(Manifest first, const CommandLine& line, const Options& options,
         const std::vector<std::string>& kept)
    : folder_(folder_of(line, options), line),
      json_(options.json),
      quiet_(options.quiet),
      manifest_(std::move(first)) {
  if (!std::exchange(any_has_begun_, true) && !json_) first_folder_ = folder();
  manifest_.files = kept;
  folder_.set_run_before_aside(kept);
  reserve({"report.html"});  // every run ends with it, or `hysteron report` writes it later
  for (const std::string& name : kept) is_new(name);
  keep();
}

Run::~Run() {
  if (finished_) return;
  try {
    finish_plots();
    keep();
  } catch (const Error& error) {
    // The exception that ended the run is in flight; this one can only be mentioned.
    unwritten_ = error.what();
  }
}

fs::path Run::path(const std::string& name) {
  if (std::count(manifest_.files.begin(), manifest_.files.end(), name)) return folder() / name;
  const fs::path file = folder_.place_for(name);
  manifest_.files.push_back(name);
  if (is_new(name) && !finished_) keep();
  return file;
}

void Run::reserve(const std::vector<std::string>& names) const {
  const std::set<std::string> own(manifest_.files.begin(), manifest_.files.end());
  for (const std::string& name : names) {
    if (!name.starts_with("plot_") || fs::path(name).has_extension()) {
      folder_.check_free(name, own);
      continue;
    }
    for (const char* ending : kPlotEndings) folder_.check_free(name + ending, own);
  }
}

bool Run::is_new(const fs::path& name) {
  return known_.insert(is_numbered(name) ? name.parent_path() / name.extension() : name).second;
}

void Run::forget(const std::string& name) {
  std::error_code ignored;
  if (std::erase(manifest_.files, name) > 0) fs::remove(folder() / name, ignored);
}

void Run::note(const std::string& key, const Json& value) {
  manifest_.own.emplace_back(key, std::make_shared<const Json>(value));
}

void Run::begun_at(std::chrono::steady_clock::time_point time) {
  add_seconds("setup", std::chrono::duration<double>(start_ - time).count());
  start_ = time;
}

void Run::serialise(Archive& archive) {
  archive(manifest_.files);
  archive(manifest_.warnings);
  archive(manifest_.started);
  archive(manifest_.command);
  using Seconds = std::chrono::duration<double>;
  double elapsed = Seconds(std::chrono::steady_clock::now() - start_).count();
  std::vector<std::pair<std::string, double>> seconds(seconds_.begin(), seconds_.end());
  archive(elapsed);
  archive(seconds);
  if (!archive.loads()) return;
  for (const std::string& name : manifest_.files) is_new(name);
  start_ -= std::chrono::duration_cast<std::chrono::steady_clock::duration>(Seconds(elapsed));
  for (const auto& [stage, spent] : seconds) add_seconds(stage, spent);
}

void Run::add_seconds(const std::string& stage, double seconds) { seconds_[stage] += seconds; }

void Run::draw_beside(const std::string& name, std::function<void(const fs::path&)> draw) {
  for (const char* ending : kPlotEndings) path(name + ending);
  plots_.push_back(
      {name, std::async(std::launch::async, [this, draw = std::move(draw), base = folder() / name] {
         const std::scoped_lock one_at_a_time(plotting_);
         draw(base);
       })});
}

void Run::plot(const std::string& name, const render::Plot& plot) {
  this->plot(name, plot, render::write_plot);
}

void Run::finish_plots() {
  const Stage stage(*this, "render");
  for (PendingPlot& plot : std::exchange(plots_, {})) {
    try {
      plot.drawn.get();
      if (!fs::exists(folder() / (plot.name + ".pdf")))
        forget(plot.name + ".pdf");  // this gnuplot writes no PDF
    } catch (const Error& error) {
      for (const char* ending : kPlotEndings) forget(plot.name + ending);
      manifest_.plots_missing.push_back(plot.name + ": " + error.what());
      warn("the plot " + plot.name + " is missing: " + error.what());
    }
  }
}

void Run::warn(const std::string& text) {
  std::vector<std::string>& given = manifest_.warnings;
  if (std::count(given.begin(), given.end(), text)) return;
  given.push_back(text);
  std::cerr << "warning: " << text << std::endl;
}

void Run::progress(const std::string& line) const {
  if (!quiet_) std::cerr << line << std::endl;
}

void Run::note_seconds(Manifest& manifest) const {
  manifest.wall_seconds = {
      {"total", std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count()}};
  if (manifest.batch) return;
  std::map<std::string, double> others = seconds_;
  for (const char* stage : kStages) {
    manifest.wall_seconds.emplace_back(stage, others[stage]);
    others.erase(stage);
  }
  manifest.wall_seconds.insert(manifest.wall_seconds.end(), others.begin(), others.end());
}

void Run::keep() const {
  Manifest manifest = manifest_;
  note_seconds(manifest);
  manifest.inputs = inputs_of_job(folder());
  write_text(folder() / "manifest.json", to_json(manifest).dump(2) + "\n");
}

void Run::finish() {
  write_last_manifest(true);
  folder_.is_complete();
}

void Run::finish_incomplete() { write_last_manifest(false); }

void Run::write_last_manifest(bool complete) {
  finish_plots();
  note_seconds(manifest_);
  manifest_.inputs = inputs_of_job(folder());
  manifest_.complete = complete;
  if (complete) manifest_.tables = written_tables(manifest_.files, folder());
  const Json json = to_json(manifest_);
  const std::string text = json.dump(2) + "\n";
  write_text(folder() / "manifest.json", text);
  manifest_ = parsed_manifest(json);
  finished_ = true;
  if (json_) std::cout << text << std::flush;
}

std::string time_left(long done, long all, double seconds, bool at_most) {
  constexpr long kFewSteps = 5;  // the first steps are slower: buffers, threads, shaders
  if (done < kFewSteps || done >= all) return "";
  const long left =
      std::lround(std::ceil(seconds * static_cast<double>(all - done) / static_cast<double>(done)));
  const long minutes = (left + 30) / 60;
  std::string text = std::to_string(left) + " s";
  if (left >= 90) text = std::to_string(minutes) + " min";
  if (minutes >= 60) text = std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
  return std::string(at_most ? "  at most " : "  ") + text + " left";
}

}  // namespace hysteron::experiments
