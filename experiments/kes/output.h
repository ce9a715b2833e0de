// Tables and plots of the virtual KES test of several laws on one fabric.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/kes/strip_output.h"
#include "experiments/workbench/app/run.h"
#include "sim/reference/kes.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

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

// loops.csv and minor_loops.csv, a column per result and a hundredth of the amplitude per row; table.csv.
void write_tables(Run& run, const KesTests& tests, const KesProtocol& protocol);

// plot_loops, plot_amplitudes and plot_minor_loops; the strips' figures.
void write_plots(Run& run, const KesTests& tests, const KesProtocol& protocol);

}  // namespace hysteron::experiments
