// Tables and plots of the KES-FB1 tests of several fabrics.
#pragma once

#include <string>
#include <vector>

#include "experiments/kes/in_plane_strip.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

enum class InPlaneTest { shear, tension };
constexpr auto names(InPlaneTest) { return std::array{"shear", "tension"}; }

// A number that the tester reads.
struct InPlaneNumber {
  const char* key;    // of the metric, with its unit
  const char* label;  // in tables, with its unit
  double value;
};

// A loop and what is read of it; `x` in degrees of shear or percent of extension.
struct InPlaneLoop {
  std::vector<double> x, force;  // force in N/m
  std::vector<InPlaneNumber> numbers;
};
InPlaneLoop in_plane_loop(const ShearTest& test);
InPlaneLoop in_plane_loop(const TensionTest& test);

struct InPlaneResult {
  Fabric fabric;
  std::string prefix;  // of its metrics: "" | fabric. where there are several
  InPlaneLoop law;
  // Of the specimen of cloth and of one of a quarter of the triangles; without numbers where none was asked
  // for.
  InPlaneLoop cloth, coarse;
  double tension = 0;  // of the specimen in shear [N/m]
  int triangles = 0;
  double seconds = 0;
};

// Numbers of the law; strip_* of the specimen, by how much they differ from the law's, and how much they
// change from a quarter of the triangles on.
void write_in_plane_metrics(Run& run, const std::vector<InPlaneResult>& results);
// loops_FABRIC.csv and plot_loops_FABRIC, without the name of a single fabric; table.csv.
void write_in_plane_tables(Run& run, const std::vector<InPlaneResult>& results, InPlaneTest test);
void write_in_plane_plots(Run& run, const std::vector<InPlaneResult>& results, InPlaneTest test);
// Beside what the fabric's file says was published, on stdout.
void print_in_plane(const std::vector<InPlaneResult>& results);

}  // namespace hysteron::experiments
