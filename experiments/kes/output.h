// Tables and plots of the virtual KES test of several laws on several fabrics.
#pragma once

#include <string>
#include <vector>

#include "experiments/kes/strip_output.h"
#include "experiments/workbench/app/run.h"
#include "sim/reference/kes.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct KesResult {
  std::string law;
  std::string name;  // in tables and metrics: "" | law | fabric.law, as much as tells results apart
  KesTest test;
  std::vector<StripResult> strips = {};  // of cloth under this law (--on strip)
};

// One fabric under all chosen laws; `reference` is `prandtl`, drawn in grey behind every law.
struct KesFabric {
  Fabric fabric;
  KesTest reference;
  std::vector<KesResult> results;
};

// B_N_m, 2HB_N, residual_curvature_per_m, loop_area_J_per_m2 and others of every result; strip_* of its
// strips.
void write_metrics(Run& run, const std::vector<KesFabric>& fabrics);

// loops.csv and minor_loops.csv, a column per result and a hundredth of the amplitude per row; table.csv.
void write_tables(Run& run, const std::vector<KesFabric>& fabrics, const KesProtocol& protocol);

// What was read, beside what the fabric's file says was published, on stdout.
void print_table(const std::vector<KesFabric>& fabrics);

// plot_loops, plot_amplitudes and plot_minor_loops; of several fabrics, each with the fabric's name added.
void write_plots(Run& run, const std::vector<KesFabric>& fabrics, const KesProtocol& protocol);

}  // namespace hysteron::experiments
