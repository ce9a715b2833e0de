// Cusick's drape by the subcommand `drape`, in folders of its own within a validation.
#pragma once

#include <string>
#include <vector>

#include "experiments/validate/validate.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// A drape and what came of it.
struct Drape {
  std::string fabric, law, standard, release, varied;  // varied: "" | mesh | step | draw-2 | sample-1
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

// Runs another subcommand into a folder of this one; its manifest.  What it warns of it has said: the
// manifest of this one keeps it, too.
Manifest result_of(const std::string& name, const std::vector<Flag>& own, const ValidateFlags& flags,
                   Run& run, const std::string& folder);

// As the flags say: with the first of their laws, on the tester that the fabric's file names.
Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags);
// What the subcommand `drape` is told; numbers lose no bit on the way.
std::vector<Flag> flags_of(const Drape& drape, const ValidateFlags& flags);
void run_drape(Drape& drape, const ValidateFlags& flags, Run& run);

// Every fabric under every law, released as on its tester and lowered alone, and the first law with four
// times the triangles and with half the step: drape.csv, plot_drape.
void compare_drapes(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
