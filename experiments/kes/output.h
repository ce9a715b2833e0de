// Tables and plots of the virtual KES test of several laws on one fabric, each alone and on a strip.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/kes/strip.h"
#include "experiments/workbench/app/run.h"
#include "render/image.h"
#include "sim/reference/kes.h"
#include "sim/scene/scene.h"

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

struct KesResult {
  std::string law;
  std::string name;  // in tables and metrics: "", or the law where there are several
  KesTest test;
  std::optional<StripResult> strip = {};  // of cloth under this law (--on strip)
};

// A fabric under all chosen laws; `reference` is `prandtl`, drawn in grey behind every law.
struct KesTests {
  Fabric fabric;
  KesTest reference;
  std::vector<KesResult> results;
};

// B_N_m, 2HB_N, residual_curvature_per_m, loop_area_J_per_m2 and others of every result; strip_* of its
// strip.
void write_metrics(Run& run, const KesTests& tests);

// Loops whose area is off by more than half a percent because their steps are few: a sentence for each.
std::vector<std::string> coarse_steps_warnings(const KesTests& tests, int steps, int strip_steps);

// loops.csv and minor_loops.csv, a column per result and a hundredth of the amplitude per row; table.csv.
void write_tables(Run& run, const KesTests& tests, const KesProtocol& protocol);

// plot_loops, plot_amplitudes and plot_minor_loops; the strips' figures.
void write_plots(Run& run, const KesTests& tests, const KesProtocol& protocol);

}  // namespace hysteron::experiments
