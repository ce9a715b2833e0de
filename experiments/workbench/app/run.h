// A run's folder and its manifest.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/app/run_folder.h"

namespace hysteron {
class Archive;
namespace render {
struct Plot;
}
}  // namespace hysteron

namespace hysteron::experiments {

// "0.1.0 (commit 1f3a..., modified)", of this program, and of the one that wrote a manifest.
std::string program_version();
std::string program_version(const Manifest& manifest);

// Ends an experiment that is only asked whether it accepts a request, before it builds a cloth or takes its
// folder; Run::only_checks_requests says so for this thread.
struct RequestAccepted {};

// Keeps what a run is and has found, and writes it as OUT/manifest.json: at the start (so that an unwritable
// folder is known before any simulation), and at the end.  A run that is destroyed without finish(), because
// of an exception, keeps its files and a manifest with "complete": false; RunFolder says what becomes of a
// run that stood there before.
class Run {
 public:
  // Takes the folder as RunFolder does, out/<experiment> where none is named.  Throws Error::invalid_input,
  // Error::system.
  // `kept`: files of a run that was interrupted and goes on as this one; serialise() tells of the rest.
  Run(const CommandLine& line, const Setup& setup, const std::vector<std::string>& kept = {});
  // Of an experiment that simulates nothing; `keys` are what it resolved, as the manifest's `scene`.
  Run(const CommandLine& line, const Options& options, const Json& keys);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const std::filesystem::path& folder() const { return folder_.path(); }
  static inline thread_local bool only_checks_requests = false;
  // Of the first run of this process, which was asked for; those of its parts lie in it.  "": none, or its
  // manifest goes to stdout.
  static const std::filesystem::path& first_folder() { return first_folder_; }
  // Why the manifest of a run of this thread could not be written after an exception had ended it; "": it
  // was.
  static const std::string& unwritten() { return unwritten_; }
  // Where to write the file of that name ("sheet.png", "frames/0000.png"); its folder is made.  It is listed
  // in the manifest, on disk at once, so that a later run knows what one that is killed has left; of a
  // sequence the first file stands for all.  Throws Error::invalid_input where it would replace another's
  // file.
  std::filesystem::path path(const std::string& name);
  // Throws Error::invalid_input, before there is work to be lost, where one of these files that will be
  // written later would replace another's.  Of a sequence the first stands for all, "plot_NAME" for its .png
  // and .svg.
  void reserve(const std::vector<std::string>& names) const;
  // The file of that name could not be written: what there is of it goes, and it is not listed.
  void forget(const std::string& name);

  // Of a page: a folder of a run that it has started.  `goes_on`: what is there may be its result already.
  void add_part(const std::filesystem::path& folder, bool goes_on) { folder_.add_part(folder, goes_on); }
  // From here on what was written stays, even if the request turns out to be wrong.
  void keep_from_here() { folder_.keep_from_here(); }

  // What is known so far; after finish() as it is read from disk.  Its wall_seconds, plots_missing, files and
  // complete are the run's own.
  Manifest& manifest() { return manifest_; }
  const Manifest& manifest() const { return manifest_; }
  // An entry that only this experiment has.
  void note(const std::string& key, const Json& value);
  // A result.  Its name ends in its unit, counts and booleans excepted: "drape_coefficient_percent".
  void metric(const std::string& name, MetricValue value) { manifest_.metrics.set(name, std::move(value)); }
  const Metrics& metrics() const { return manifest_.metrics; }

  // What led to this run began then: it counts to the total, and as stage `setup`.
  void begun_at(std::chrono::steady_clock::time_point time);
  // Adds to wall_seconds of a stage (membrane, bending, solve, contact, history, render, encode, io, or any
  // other).  Runs that share a GPU take turns in all of them and keep their total alone.
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

  // Has `write` draw a copy of the page, as NAME.png and NAME.svg from the path without ending that it is
  // given, one after the other beside what the run does next.  Where that fails, as without gnuplot, the run
  // goes on, and the manifest's `plots_missing` says why.
  template <class Page>
  void plot(const std::string& name, const Page& page,
            void (*write)(const std::filesystem::path& base, const Page& page)) {
    draw_beside(name, [page, write](const std::filesystem::path& base) { write(base, page); });
  }
  void plot(const std::string& name, const render::Plot& plot);
  // Waits for them.
  void finish_plots();

  // Says "warning: TEXT" on stderr, with --quiet too, and keeps the text in the manifest's `warnings`; once.
  void warn(const std::string& text);
  // A line of progress on stderr, unless --quiet.
  void progress(const std::string& line) const;

  // What is known of the run and was found before an instant at which it may be interrupted: files first.
  // Results are not: they are found anew.
  void serialise(Archive& archive);

  // Writes what is known so far, as of a run that is not complete: work that follows may be interrupted.
  // Throws Error::system.
  void keep() const;
  // Writes the complete manifest, and prints it on stdout with --json.  Throws Error::system.
  void finish();
  // The same of a page that lacks some of its runs: its manifest says "complete": false, and what stood in
  // the folder before is kept beside it.
  void finish_incomplete();

 private:
  Run(Manifest first, const CommandLine& line, const Options& options, const std::vector<std::string>& kept);
  void note_seconds(Manifest& manifest) const;
  void write_last_manifest(bool complete);
  // Whether no file of that name or, of a sequence, of its kind is in the manifest on disk; now it is known.
  bool is_new(const std::filesystem::path& name);
  void draw_beside(const std::string& name, std::function<void(const std::filesystem::path& base)> draw);

  struct PendingPlot {
    std::string name;
    std::future<void> drawn;
  };

  static inline bool any_has_begun_ = false;
  static inline std::filesystem::path first_folder_;
  static inline thread_local std::string unwritten_;

  RunFolder folder_;
  bool json_, quiet_, finished_ = false;
  Manifest manifest_;
  std::map<std::string, double> seconds_;
  std::set<std::filesystem::path>
      known_;  // files and, by folder and ending, sequences, in the manifest on disk
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex plotting_;
  std::vector<PendingPlot> plots_;
};

// "  12 s left", "  3 min left", "  1 h 5 min left", by the `seconds` that `done` of `all` steps have taken;
// "" before a few steps and after the last.  `at_most`: the run may end earlier, at rest.
std::string time_left(long done, long all, double seconds, bool at_most);

}  // namespace hysteron::experiments
