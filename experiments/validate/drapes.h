// What `hysteron validate` is asked for, and Cusick's drape by the subcommand `drape`, in folders of its own
// within a validation: also how much of it is known, with the fabric's uncertain numbers anywhere in their
// ranges.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/app/run.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

// The keys of the command line.
struct ValidateFlags {
  std::string parts = "spread";
  std::string fabrics = "cotton-broad,wool-tropical,polyester-tropical,polyester-faille";
  std::string law = "prandtl", device = "cpu";
  std::string standard = "published";  // whose apparatus drapes are made on
  std::string recorded = "results";    // folder of results that are drawn
  double triangles = 6000, step = 1.0 / 120, tolerance = 1e-5;
  double seconds = 0;  // longest of a drape; 0: as the drape has it
  int samples = 8;     // of each fabric's uncertain numbers
  int draws = 3;       // meshes for the mean of a drape in a budget
  unsigned seed = 1;   // of the samples
  int batch = 1;       // drapes that share a process
  bool resume = false;
  Options options;
};

// A drape and what came of it.
struct Drape {
  std::string fabric, law, standard, release, varied;  // varied: sample-1 | budget-3-1
  int triangles = 0;
  std::string label = {};                       // of the fabric: its name, where `fabric` is a file
  std::vector<Flag> further = {};               // what else sets it apart
  std::map<std::string, double> drawn = {};     // from ranges, before keep_what_was_measured()
  std::map<std::string, double> measured = {};  // on the same tester, by the metric that predicts it
  Metrics metrics{};
  double seconds = 0;

  std::string name() const {
    return label + "-" + law + "-" + release + (varied.empty() ? "" : "-" + varied);
  }
  double number(const std::string& key) const { return metrics.number(key); }
  double coefficient() const { return number("drape_coefficient_percent"); }
  // NaN where its fabric's was measured on another tester.
  double published(const std::string& metric = "drape_coefficient_percent") const {
    const auto found = measured.find(metric);
    return found == measured.end() ? NAN : found->second;
  }
};

// The numbers that were measured of the fabric on that standard's tester, by the metric that predicts each.
std::map<std::string, double> measured_on(const std::string& standard, const Fabric& fabric);

// As the flags say, on the tester that the fabric's file names.
Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags);
// What the subcommand `drape` is told; numbers lose no bit on the way.
std::vector<Flag> drape_flags(const Drape& drape, const ValidateFlags& flags);
// Each in a folder of the run, side by side.  What they warn of the run does, too.  Throws Error::simulation
// where one of them cannot go on.
void run_drapes(std::vector<Drape>& drapes, const ValidateFlags& flags, Run& run);

// Numbers of a fabric by their keys.
using Sample = std::map<std::string, double>;

// The ranges that the fabric's file states: of its parameters by their keys, and of what a tester printed,
// "B" [N m] and "2HB" [N] of three numbers.  Throws Error::invalid_input for ranges that would change
// nothing.
std::map<std::string, Range> uncertain_numbers(const FabricFile& file);

// A Latin hypercube of these ranges (McKay, Beckman & Conover 1979): each number once in each of `count`
// parts of its range that are equal in the logarithm, which part with which by chance.
std::vector<Sample> drawn_samples(const FabricFile& file, int count, unsigned seed);

// B and 2HB, drawn or as published, become b1 and b2 for each k0, as the means of warp and weft, whatever the
// ratios of these are; beside the mean of both rigidities bias-bending stays what was drawn.
void keep_what_was_measured(const Fabric& fabric, Sample& sample);

double mean_value(const std::vector<double>& values);
// Standard deviation of one, of at least two.
double sample_deviation(const std::vector<double>& values);
// Half of the interval in which one more of `count` >= 2 normal values lies with 95 %, over their standard
// deviation: Student's t at 97.5 %, times (1 + 1/count)^1/2.
double reach_of_next(std::size_t count);

// As a drape is told of it, with all bits.
std::vector<Flag> drape_flags(const Sample& sample);

// Each fabric on its tester with `samples` draws of its uncertain numbers, each on another mesh: spread.csv,
// plot_spread, beside what was measured predictions.csv, and how much each number moves the drape,
// effects.csv.
void predict_spread(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
