// What the runs that a page sets side by side warn of, as warnings of the page itself.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

class ColumnWarnings {
 public:
  // What the run's manifest warns of, and why it could not go on.
  void hear(const ChildRun& column);
  void hear(const std::string& name, const std::vector<std::string>& texts);
  // Each text once, with the names of the runs that give it: "linear, dahl: in 3 parts of steps ...".  Of
  // many texts the first, and how many there are.
  void say(Run& run) const;

 private:
  struct Heard {
    std::string text;
    std::vector<std::string> names;
  };
  std::vector<Heard> heard_;  // as they came
};

}  // namespace hysteron::experiments
