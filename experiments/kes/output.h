// Writes tables and plots of the virtual KES test of several laws on one fabric, each alone and on a strip.
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

inline constexpr double kMilli = 1e3;  // mN in 1 N: moments are drawn in mN

// A picture of the strip at one curvature.
struct StripPicture {
  render::Image image;
  std::string letter;                // label in the loop's plot
  double curvature = 0, moment = 0;  // curvature [1/m], moment [N]
};

struct StripResult {
  ClampedStrip strip;
  StripTest test;
  std::string failure;  // why the test failed, if no equilibrium was found; else empty
  std::vector<StripPicture> pictures;
  std::string renderer;  // name of the pictures' renderer
};

// The differences of a strip's readings from those of the law alone through the same curvatures [%].  NaN
// where the law reads zero (the width of an elastic law's loop).
struct StripDifference {
  double rigidity, loop_width, residual, loop_area;
};
StripDifference difference(const StripTest& strip, double amplitude);

// Writes PREFIX strip_B_N_m, strip_2HB_N ... and their differences, or strip_failure; `amplitude` is the
// protocol's [1/m].
void write_strip_metrics(Run& run, const std::string& prefix, double amplitude, const StripResult& result);
// Writes strip ENDING.csv of a tested strip: the law and the strip, an equilibrium per row.
void write_strip_table(Run& run, const std::string& ending, const StripResult& result);
// Draws plot_strip ENDING with loops and differences, and strip ENDING.png, which adds pictures of the strip.
void write_strip_figures(Run& run, const std::string& ending, const StripResult& result);

struct KesResult {
  std::string law;
  std::string name;  // prefix in tables and metrics: "", or the law if there are several
  KesTest test;
  std::optional<StripResult> strip = {};  // the test on cloth under this law (--on strip)
};

// A fabric under all chosen laws; `reference` is `prandtl`, drawn in grey behind every law.
struct KesTests {
  Fabric fabric;
  KesTest reference;
  std::vector<KesResult> results;
};

// Writes B_N_m, 2HB_N, residual_curvature_per_m, loop_area_J_per_m2 and others of every result; strip_* of
// its strip.
void write_metrics(Run& run, const KesTests& tests);

// Returns a sentence for each loop whose area is wrong by more than half a percent because its steps are few.
std::vector<std::string> coarse_steps_warnings(const KesTests& tests, int steps, int strip_steps);

// Writes loops.csv and minor_loops.csv, with a column per result and a hundredth of the amplitude per row;
// table.csv.
void write_tables(Run& run, const KesTests& tests, const KesProtocol& protocol);

// Draws plot_loops, plot_amplitudes and plot_minor_loops; the strips' figures.
void write_plots(Run& run, const KesTests& tests, const KesProtocol& protocol);

}  // namespace hysteron::experiments
