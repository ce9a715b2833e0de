// The figure of a validation, from raw loop to decay, drape and folds, drawn from recorded results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "render/plot_page.h"

namespace hysteron::experiments {

// What is measured or known of a drape, beside what is predicted of it [%].
struct PredictedDrape {
  std::string fabric;
  double measured = NAN;
  double mean = NAN,
         elastic = NAN;          // under `prandtl` and `linear`, on several meshes; other laws are left out
  double low = NAN, high = NAN;  // 95 %, with the fabric's uncertain numbers in their ranges
};
// From the means of a study and, for each of its fabrics, FABRIC/predictions.csv in the folder `spread`.
std::vector<PredictedDrape> read_drapes(const std::filesystem::path& means,
                                        const std::filesystem::path& spread);

// One for each fabric in all plots, which colour-blind eyes can tell apart (Okabe & Ito 2008).
std::string fabric_color(std::size_t fabric);

// Loops, decay, drapes and folds, from the folders below `recorded`.  Throws Error::system,
// Error::invalid_input where one of their files is missing or another than it was.
render::PlotPage validation_page(const std::filesystem::path& recorded);

// Throws Error::invalid_input, naming the first of these files that is missing.
void check_recorded(const std::filesystem::path& recorded);

// plot_validation; plot_folds; plot_effects of the fabrics of the spread.
void draw_recorded(const std::filesystem::path& recorded, Run& run);

}  // namespace hysteron::experiments
