// Tables and plots of the KES-FB1 tests.
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
  const char* label;  // in table.csv, with its unit
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
void write_in_plane_metrics(Run& run, const InPlaneResult& result);
// loops.csv, strip.csv, and table.csv: beside what the fabric's file says was published.
void write_in_plane_tables(Run& run, const InPlaneResult& result, InPlaneTest test);
// plot_loops.
void write_in_plane_plot(Run& run, const InPlaneResult& result, InPlaneTest test);

}  // namespace hysteron::experiments
