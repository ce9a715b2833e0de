// Sets aside a run that another one replaces: its files stay in a folder inside its own until the successor
// is complete.
//
//   OUT/manifest.json, OUT/frames/0000.png  ->  OUT/.before/manifest.json, OUT/.before/frames/0000.png
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// The kind of successor determines where a run's files wait: for a run in .before or, if it was interrupted,
// in .stopped; for a page that repeats it in .page-before, since the repeated run sets aside what it finds,
// too.
enum class Successor { run, page };

// True if a folder of that name holds a run that was set aside.
bool is_set_aside(const std::filesystem::path& folder);

class SetAside {
 public:
  SetAside(std::filesystem::path folder, Successor successor);

  // Moves the files of the run in the folder that are not `kept`.  A run that was set aside there earlier is
  // removed if this one is complete, too.  Throws Error::system if a file cannot be moved, and
  // Error::invalid_input if the folder to wait in is a file or a link.
  void move(const std::set<std::filesystem::path>& kept = {});

  bool has_run() const { return !slot_.empty(); }
  // True if the folder now holds a complete run that has replaced none.
  bool has_new_complete_run() const;
  // `place` is where complete runs wait; `has_complete_run` is true if one does, whoever has set it aside.
  std::filesystem::path place() const { return folder_ / before_name_; }
  bool has_complete_run() const;
  // True if the successor has left more than a manifest.
  bool has_results_since() const;

  // Removes what the successor has left and moves all back; does nothing if there was nothing to move.
  void restore();
  // Removes the waiting run when the successor is complete.
  void remove();
  // Keeps the waiting run only if it is complete, when the successor has ended early.
  void keep_if_complete();

 private:
  std::set<std::filesystem::path> files_since() const;

  std::filesystem::path folder_;
  std::string before_name_, stopped_name_;
  std::set<std::filesystem::path> kept_;
  bool has_begun_ = false;      // true after move()
  std::filesystem::path slot_;  // "" if there was no run
  std::vector<std::filesystem::path> moved_;
};

}  // namespace hysteron::experiments
