// The flags of `hysteron validate`, and Cusick's drape by the subcommand `drape`, in folders of its own
// within a validation, also with the fabric's uncertain numbers drawn from their ranges.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "experiments/drape/apparatus.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/app/run.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

// The tester on which drapes are simulated: that which the fabric's file names, or one for all.
enum class ValidatedTester { published, iso9073, jis };
constexpr std::array<const char*, 3> names(ValidatedTester) { return {"published", "iso9073", "jis"}; }

// The keys of the command line.
struct ValidateFlags {
  std::string parts = "spread";
  std::string fabrics = "cotton-broad,wool-tropical,polyester-tropical,polyester-faille";
  std::string law = "prandtl";
  NamedDevice device = NamedDevice::cpu;
  ValidatedTester standard = ValidatedTester::published;
  std::string recorded = "results";  // folder of the results that are drawn
  double triangles = 6000, step = 1.0 / 120, tolerance = 1e-5;
  double seconds = 0;  // longest duration of a drape [s]; 0: its own default
  int samples = 8;     // number of draws of each fabric's uncertain numbers
  int draws = 3;       // number of meshes for the mean of a drape in a budget
  unsigned seed = 1;   // seed of the samples
  int jobs = 0;        // number of processes at a time; 0: one for each GPU, or for each core
  int batch = 1;       // number of drapes that share a process
  bool resume = false;
  Options options;
};

// A drape and its results.
struct Drape {
  std::string fabric, law;
  DrapeStandard standard = DrapeStandard::iso9073;
  DrapeRelease release = DrapeRelease::lowered;
  std::string varied;  // sample-1 or budget-3-1
  int triangles = 0;
  std::string label = {};                    // the fabric's name, if `fabric` is a file
  std::vector<Flag> further = {};            // its other flags
  std::map<std::string, double> drawn = {};  // drawn from ranges, before keep_what_was_measured()
  // Published on the same tester, by the metric that predicts it.
  std::map<std::string, double> measured = {};
  Metrics metrics{};
  double seconds = 0;

  std::string name() const {
    return label + "-" + law + "-" + enum_name(release) + (varied.empty() ? "" : "-" + varied);
  }
  double number(const std::string& key) const { return metrics.number(key); }
  double coefficient() const { return number("drape_coefficient_percent"); }
  // Returns the published number; NaN if the fabric's was measured on another tester.
  double published(const std::string& metric = "drape_coefficient_percent") const {
    const auto found = measured.find(metric);
    return found == measured.end() ? NAN : found->second;
  }
};

// Returns the numbers of the fabric published for that standard's tester, by the metric that predicts each.
std::map<std::string, double> measured_on(DrapeStandard standard, const Fabric& fabric);

// Returns the drape according to the flags, on the tester that the fabric's file names.
Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags);
// Returns the flags for the subcommand `drape`.
std::vector<Flag> drape_flags(const Drape& drape, const ValidateFlags& flags);
// Runs each drape in a folder of the run, side by side, and repeats their warnings.  Throws Error::simulation
// if one of them cannot go on.
void run_drapes(std::vector<Drape>& drapes, const ValidateFlags& flags, Run& run);

// A sample holds numbers of a fabric by their keys.
using Sample = std::map<std::string, double>;

// Returns the ranges that the fabric's file states, of its parameters by their keys, and of what a tester
// printed, "B" [N m] and "2HB" [N] of three numbers.  Throws Error::invalid_input for ranges that would
// change nothing.
std::map<std::string, Range> uncertain_numbers(const FabricFile& file);

// Returns a Latin hypercube of these ranges (McKay, Beckman & Conover 1979): each number lies once in each of
// `count` parts of its range that are equal in the logarithm, in a random order.
std::vector<Sample> drawn_samples(const FabricFile& file, int count, unsigned seed);

// Converts B and 2HB, drawn or published, to b1 and b2 for each k0, as the means of warp and weft, whatever
// the ratios of these are; bias-bending remains relative to the mean of both rigidities, as drawn.
void keep_what_was_measured(const Fabric& fabric, Sample& sample);

double mean_value(const std::vector<double>& values);
// Returns the standard deviation of at least two values.
double sample_deviation(const std::vector<double>& values);
// Returns half of the interval in which one more of `count` >= 2 normal values lies with 95 %, over their
// standard deviation: Student's t at 97.5 %, times (1 + 1/count)^1/2.
double reach_of_next(std::size_t count);

// Returns the sample as flags of `drape`, in full precision.
std::vector<Flag> drape_flags(const Sample& sample);

// Drapes each fabric on its tester with `samples` draws of its uncertain numbers, each on another mesh, and
// writes spread.csv, plot_spread, predictions.csv beside the measured values, and effects.csv with how much
// each number moves the drape.
void predict_spread(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
