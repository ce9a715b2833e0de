// Cusick's drape by the subcommand `drape`, in folders of its own within a validation.
#pragma once

#include <string>
#include <vector>

#include "experiments/validate/validate.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// A drape and what came of it.
struct Drape {
  std::string fabric, law, standard, release, varied;  // varied: sample-1 | budget-3-1
  int triangles = 0;
  double step = 0, tolerance = 0;
  std::vector<Flag> further = {};  // what else sets it apart
  Metrics metrics{};
  double seconds = 0;

  std::string name() const {
    return fabric + "-" + law + "-" + release + (varied.empty() ? "" : "-" + varied);
  }
  double number(const std::string& key) const { return metrics.number(key); }
  double coefficient() const { return number("drape_coefficient_percent"); }
  double published() const { return number("published_drape_coefficient_percent"); }
};

// As the flags say, on the tester that the fabric's file names.
Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags);
// What the subcommand `drape` is told; numbers lose no bit on the way.
std::vector<Flag> drape_flags(const Drape& drape, const ValidateFlags& flags);
// Each in a folder of the run, side by side.  What they warn of the run does, too.  Throws Error::simulation
// where one of them cannot go on.
void run_drapes(std::vector<Drape>& drapes, const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
