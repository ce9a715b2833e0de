// What the KES test of strips has found, beside what the law alone gives.
#pragma once

#include <string>
#include <vector>

#include "experiments/kes/strip.h"
#include "experiments/workbench/app/run.h"
#include "render/image.h"

namespace hysteron::experiments {

inline constexpr double kMilli = 1e3;  // moments are drawn in mN

// Of the strip at one curvature.
struct StripPicture {
  render::Image image;
  std::string letter;                // in the loop's plot
  double curvature = 0, moment = 0;  // [1/m], [N]
};

struct StripResult {
  ClampedStrip strip;
  StripTest test;
  std::string failure;  // why there is no test: where no equilibrium was found; else empty
  std::vector<StripPicture> pictures;
  std::string renderer;  // of the pictures
};

// A reading of a strip over that of the law alone through the same curvatures, minus 1 [percent].  NaN where
// the law reads nothing (the width of an elastic law's loop).
struct StripDifference {
  double rigidity, loop_width, residual, loop_area;
};
StripDifference difference(const StripTest& strip, double amplitude);

// PREFIX strip_B_N_m, strip_2HB_N ... and their differences, or strip_failure; `amplitude` as in the
// protocol.
void write_strip_metrics(Run& run, const std::string& prefix, double amplitude, const StripResult& result);
// Of a strip that was tested.  strip ENDING.csv: the law and the strip, an equilibrium per row.
void write_strip_table(Run& run, const std::string& ending, const StripResult& result);
// plot_strip ENDING: loops and differences; strip ENDING.png: the same with pictures of the strip.
void write_strip_figures(Run& run, const std::string& ending, const StripResult& result);

}  // namespace hysteron::experiments
