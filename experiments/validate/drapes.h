// Cusick's drape by the subcommand `drape`, in folders of its own within a validation.
#pragma once

#include <string>
#include <vector>

#include "experiments/validate/validate.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/variants.h"

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

// Runs of another subcommand, each in a folder of this one, side by side; their manifests.  What they warn of
// this one does, too.  Throws Error::simulation where one of them cannot go on.
std::vector<Manifest> run_manifests(const std::string& experiment, const std::vector<Variant>& runs,
                                    const ValidateFlags& flags, Run& run);

// As the flags say: with the first of their laws, on the tester that the fabric's file names.
Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags);
// What the subcommand `drape` is told; numbers lose no bit on the way.
std::vector<Flag> drape_flags(const Drape& drape, const ValidateFlags& flags);
void run_drapes(std::vector<Drape>& drapes, const ValidateFlags& flags, Run& run);

// Every fabric under every law, released as on its tester and lowered alone, and the first law with four
// times the triangles and with half the step: drape.csv, plot_drape.
void compare_drapes(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
