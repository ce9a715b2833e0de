// A run with its folder and its manifest.
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

// Returns "0.1.0 (commit 1f3a..., modified)" for this program, or for the one that wrote a manifest.
std::string program_version();
std::string program_version(const Manifest& manifest);

// Collects a run's description and results, and writes them as OUT/manifest.json: at the start (so that an
// unwritable folder is known before any simulation), and at the end.  A run that is destroyed without
// finish(), because of an exception, keeps its files and a manifest with "complete": false; RunFolder decides
// what happens to an earlier run in the folder.
class Run {
 public:
  // Takes the folder as RunFolder does, out/<experiment> by default.  Throws Error::invalid_input,
  // Error::system.  `kept` are files of an interrupted run that this one continues; serialise() restores the
  // rest.
  Run(const CommandLine& line, const Setup& setup, const std::vector<std::string>& kept = {});
  // Makes a run of an experiment that simulates nothing; `keys` are its resolved ones, which become the
  // manifest's `scene`.
  Run(const CommandLine& line, const Options& options, const Json& keys);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const std::filesystem::path& folder() const { return folder_.path(); }
  // Returns the folder of the first run of this process, which contains those of its parts; "" if there is
  // none or its manifest goes to stdout.
  static const std::filesystem::path& first_folder() { return first_folder_; }
  // Returns why the manifest of a run of this thread could not be written after an exception had ended it; ""
  // if it was.
  static const std::string& unwritten() { return unwritten_; }
  // Returns the path for the file of that name ("sheet.png", "frames/0000.png"); its folder is made.  The
  // file is listed in the manifest, on disk at once, so that a later run knows the files of a killed one; the
  // first file of a sequence represents all.  Throws Error::invalid_input if it would replace another
  // program's file.
  std::filesystem::path path(const std::string& name);
  // Throws Error::invalid_input, before there is work to be lost, if one of these files that will be written
  // later would replace another's.  The first file of a sequence represents all, "plot_NAME" its .png and
  // .svg.
  void reserve(const std::vector<std::string>& names) const;
  // Removes the remains of a file that could not be written from the folder and the list.
  void forget(const std::string& name);

  // Adds the folder of a run that a page has started.  `goes_on` is true if it may already hold that run's
  // result.
  void add_part(const std::filesystem::path& folder, bool goes_on) { folder_.add_part(folder, goes_on); }
  // From here on written files stay, even if the request turns out to be wrong.
  void keep_from_here() { folder_.keep_from_here(); }

  // Returns what is known so far, and after finish() what was read from disk.  Its wall_seconds,
  // plots_missing, files and complete are set by the run.
  Manifest& manifest() { return manifest_; }
  const Manifest& manifest() const { return manifest_; }
  // Adds an entry that only this experiment has.
  void note(const std::string& key, const Json& value);
  // Adds a result.  Its name ends in its unit, except for counts and booleans: "drape_coefficient_percent".
  void metric(const std::string& name, MetricValue value) { manifest_.metrics.set(name, std::move(value)); }
  const Metrics& metrics() const { return manifest_.metrics; }

  // Sets an earlier beginning of the run: the time since then counts to the total, and as stage `setup`.
  void begun_at(std::chrono::steady_clock::time_point time);
  // Adds to wall_seconds of a stage (membrane, bending, solve, contact, history, render, encode, io, or any
  // other).  Runs that share a GPU alternate in all stages and record their total alone.
  void add_seconds(const std::string& stage, double seconds);
  // Measures from construction to destruction of the object.
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

  // Draws a copy of the page with `write`, as NAME.png and NAME.svg from the path without ending, one after
  // the other beside what the run does next.  If that fails, as without gnuplot, the run goes on, and the
  // manifest's `plots_missing` gives the reason.
  template <class Page>
  void plot(const std::string& name, const Page& page,
            void (*write)(const std::filesystem::path& base, const Page& page)) {
    draw_beside(name, [page, write](const std::filesystem::path& base) { write(base, page); });
  }
  void plot(const std::string& name, const render::Plot& plot);
  // Waits for the plots.
  void finish_plots();

  // Prints "warning: TEXT" on stderr, with --quiet too, and keeps the text in the manifest's `warnings`;
  // once.
  void warn(const std::string& text);
  // Prints a line of progress on stderr, unless --quiet.
  void progress(const std::string& line) const;

  // Serialises what is known of the run up to an instant at which it may be interrupted, in particular files.
  // Results are not included: they are found anew.
  void serialise(Archive& archive);

  // Writes what is known so far, as for an incomplete run: the work that follows may be interrupted. Throws
  // Error::system.
  void keep() const;
  // Writes the complete manifest, and prints it on stdout with --json.  Throws Error::system.
  void finish();
  // Does the same for a page that lacks some of its runs: its manifest says "complete": false, and an earlier
  // run in the folder is kept beside it.
  void finish_incomplete();

 private:
  Run(Manifest first, const CommandLine& line, const Options& options, const std::vector<std::string>& kept);
  void note_seconds(Manifest& manifest) const;
  void write_last_manifest(bool complete);
  // True if the manifest on disk lists no file of that name or, for a sequence, of its kind; it is then
  // known.
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
  std::set<std::filesystem::path> known_;  // listed files and, by folder and ending, sequences
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex plotting_;
  std::vector<PendingPlot> plots_;
};

// Returns "  12 s left", "  3 min left", "  1 h 5 min left", by the `seconds` that `done` of `all` steps have
// taken; "" before a few steps and after the last.  With `at_most` the run may end earlier, at rest.
std::string time_left(long done, long all, double seconds, bool at_most);

}  // namespace hysteron::experiments
