// Draws the figure of a validation, from raw loop to decay, drape and folds, from recorded results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "render/plot_page.h"

namespace hysteron::experiments {

// The measured drape coefficient of a fabric and its prediction [%].
struct PredictedDrape {
  std::string fabric;
  double measured = NAN;
  double mean = NAN,
         elastic = NAN;          // under `prandtl` and `linear`, over several meshes; other laws are left out
  double low = NAN, high = NAN;  // 95 % interval over the ranges of the fabric's uncertain numbers
};
// Reads the means of a study and, for each of its fabrics, FABRIC/predictions.csv in the folder `spread`.
std::vector<PredictedDrape> read_drapes(const std::filesystem::path& means,
                                        const std::filesystem::path& spread);
// Reads those of a folder of recorded results.
std::vector<PredictedDrape> recorded_drapes(const std::filesystem::path& recorded);

// Returns a fabric's colour in all plots, which colour-blind eyes can distinguish (Okabe & Ito 2008).
std::string fabric_color(std::size_t fabric);

// Draws loops, decay, drapes and folds, from the folders below `recorded`.  Throws Error::system,
// Error::invalid_input if one of their files is missing or has another format.
render::PlotPage validation_page(const std::filesystem::path& recorded,
                                 const std::vector<PredictedDrape>& drapes);

// Throws Error::invalid_input, naming the first of these files that is missing.
void check_recorded(const std::filesystem::path& recorded);

// Draws plot_validation, plot_folds, and plot_effects of the fabrics of the spread.
void draw_recorded(const std::filesystem::path& recorded, Run& run);

}  // namespace hysteron::experiments
