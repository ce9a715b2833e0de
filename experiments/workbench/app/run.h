// A run's folder and its manifest.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run_folder.h"

namespace hysteron::experiments {

using Json = nlohmann::ordered_json;

// "0.1.0 (commit 1f3a..., modified)"
std::string program_version();

// Keeps what a run is and has found, and writes it as OUT/manifest.json: at the start (so that an unwritable
// folder is known before any simulation), and at the end.  A run that is destroyed without finish(), because
// of an exception, keeps its files and a manifest with "complete": false.
class Run {
 public:
  // Takes the folder as RunFolder does.  Throws Error::request, Error::machine.
  Run(const CommandLine& line, const Setup& setup);
  // Of an experiment that simulates nothing; `keys` are what it resolved, as the manifest's `scene`.
  Run(const CommandLine& line, const Options& options, const Json& keys);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const std::filesystem::path& folder() const { return folder_.path(); }
  // Of the first run of this process, which was asked for; those of its parts lie in it.  "": none, or its
  // manifest goes to stdout.
  static const std::filesystem::path& first_folder();
  // Where to write the file of that name ("sheet.png", "frames/0000.png"); its folder is made.  It is listed
  // in the manifest, on disk at once, so that a later run knows what one that is killed has left; of a
  // sequence the first file stands for all.  Throws Error::request where it would replace another's file.
  std::filesystem::path path(const std::string& name);
  // The file of that name could not be written: what there is of it goes, and it is not listed.
  void forget(const std::string& name);

  // Entries of the manifest's top level: device, renderer, positions, triangles, hinges, steps,
  // seconds_simulated, bytes_device, state_hash, and others.
  void note(const std::string& key, Json value);
  // A result.  Its name ends in its unit, counts and booleans excepted: "drape_coefficient_percent".
  void metric(const std::string& name, Json value);
  const Json& metrics() const { return metrics_; }
  // What was noted under that key; null if nothing was.
  Json noted(const std::string& key) const { return entries_.value(key, Json()); }
  // The ledger's closing balance, term by term [J].
  void energy(const std::vector<std::pair<std::string, double>>& terms);

  // Adds to wall_seconds of a stage (membrane, bending, solve, contact, history, render, encode, io, or
  // other).
  void add_seconds(const std::string& stage, double seconds);
  // Measures from now until the end of the returned object's life.
  class Stage {
   public:
    Stage(Run& run, std::string name) : run_(run), name_(std::move(name)) {}
    ~Stage() { run_.add_seconds(name_, std::chrono::duration<double>(Clock::now() - start_).count()); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    Run& run_;
    std::string name_;
    Clock::time_point start_ = Clock::now();
  };
  [[nodiscard]] Stage stage(const std::string& name) { return {*this, name}; }

  // Has `draw` write NAME.png and NAME.svg from the path without ending that it is given.  Where that fails,
  // as without gnuplot, the run goes on, and the manifest's `plots_missing` says why.
  void plot(const std::string& name, const std::function<void(const std::filesystem::path& base)>& draw);

  // A line of progress on stderr, unless --quiet.
  void progress(const std::string& line) const;

  // Writes what is known so far, as of a run that is not complete: work that follows may be interrupted.
  // Throws Error::machine.
  void keep() const { write_manifest(false); }
  // Writes the complete manifest, and prints it on stdout with --json.  Throws Error::machine.
  void finish();

 private:
  Json manifest(bool complete) const;
  void write_manifest(bool complete) const;

  RunFolder folder_;
  bool json_, quiet_, finished_ = false;
  Json entries_;  // of the manifest, in its order; null where not known
  Json metrics_ = Json::object();
  std::map<std::string, double> seconds_;
  std::vector<std::string> files_;
  std::set<std::filesystem::path>
      known_;  // files and, by folder and ending, sequences, in the manifest on disk
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace hysteron::experiments
