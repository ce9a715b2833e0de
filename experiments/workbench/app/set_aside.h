// A run that another one replaces: its files stay in a folder inside its own until the successor is complete.
//
//   OUT/manifest.json, OUT/frames/0000.png  ->  OUT/.before/manifest.json, OUT/.before/frames/0000.png
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// What replaces a run, and so where its files wait: by themselves a run's in .before or, if it was
// interrupted, in .stopped; those of a run that a page repeats in .page-before, since the run sets aside what
// it finds, too.
enum class Successor { run, page };

// Whether a folder of that name holds a run that was set aside.
bool is_set_aside(const std::filesystem::path& folder);

class SetAside {
 public:
  SetAside(std::filesystem::path folder, Successor successor);

  // Moves the files of the run in the folder that are not `kept`.  One that was set aside there earlier is
  // removed if this one is complete, too.  Throws Error::system where a file cannot be moved, and
  // Error::invalid_input where the folder to wait in is a file or a link.
  void move(const std::set<std::filesystem::path>& kept = {});

  bool has_run() const { return !slot_.empty(); }
  // Whether the folder holds a complete run now, which has replaced none.
  bool has_new_complete_run() const;
  // Where complete runs wait, and whether one does, whoever has set it aside.
  std::filesystem::path place() const { return folder_ / before_name_; }
  bool has_complete_run() const;
  // Whether the successor has left more than a manifest.
  bool has_results_since() const;

  // Takes away what the successor has left and moves all back; nothing where nothing was to be moved.
  void restore();
  // The successor is complete: what waits here goes.
  void remove();
  // The successor has ended before its time: only a complete run goes on waiting.
  void keep_if_complete();

 private:
  std::set<std::filesystem::path> files_since() const;

  std::filesystem::path folder_;
  std::string before_name_, stopped_name_;
  std::set<std::filesystem::path> kept_;
  bool has_begun_ = false;      // move()
  std::filesystem::path slot_;  // "": there was no run
  std::vector<std::filesystem::path> moved_;
};

}  // namespace hysteron::experiments
