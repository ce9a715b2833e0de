// A study is one experiment with the flags that all of its runs share and the axes along which they differ.
//
//   study file -> axes -> runs, every combination of their values -> a folder each, OUT/runs/NAME/
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/compare/workflow.h"

namespace hysteron::experiments {

struct StudyAxis {
  std::string key;                  // key of a scene or the experiment: "fabric.k0", "param.stack"
  std::string unit;                 // unit of its values, "" for texts
  std::vector<std::string> values;  // as flags take them, in the order of the runs
  bool numeric = false;             // true if all values are numbers
  bool logarithmic = false;         // scale in plots
  bool sampled = false;             // drawn together with the other sampled axes, not on a grid
};

// The key of the axis of repeated draws.
inline constexpr const char* kSeedKey = "seed";
bool is_seed(const StudyAxis& axis);

struct StudyRun {
  std::string name;                 // name of its folder: "k0=12.5,law=dahl,seed=3"
  std::vector<std::string> values;  // one value of each axis
};

struct Study {
  std::string file;  // the study file, or a sweep's manifest
  std::string name;  // name as the user gave it
  std::string experiment;
  std::vector<Flag> shared;  // flags that all runs share
  std::vector<StudyAxis> axes;
  std::vector<std::string> metrics;  // metrics on pages; if empty, the experiment's headlines
  std::string metrics_place;         // where the file sets them: "study.toml:2"
  JobResources resources;            // resources of a job on a cluster
  int runs_a_job = 1;                // number of runs in a job, one after the other
  std::vector<StudyRun> runs;
};

// Reads a study from a file, from assets/studies, or from a sweep's manifest, which lacks its [resources].
// Throws Error::system if it cannot be read, Error::invalid_input with file, line, key and the allowed values
// for everything that a run would refuse of a single key.
Study read_study(const std::string& name_or_file);

// Returns every combination of the axes' values, the last axis varying fastest; sampled axes go together.
// Names are valid file names everywhere and differ from each other.
std::vector<StudyRun> runs_on_axes(const std::vector<StudyAxis>& axes);

// Returns `n` numbers in [0, 1) for each of `axes`, by axis: every n-th part of an axis is drawn from once,
// in an order of its own (McKay, Beckman & Conover 1979, Technometrics 21:239).  The same seed gives the same
// numbers on every machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint64_t seed);

// Returns the flag of the experiment that sets a study's key to this value: {"param", "stack=8"} for
// "param.stack".
Flag flag_of(const std::string& experiment, const std::string& key, const std::string& value);
// Returns the command line of a run.
CommandLine run_command_line(const Study& study, const StudyRun& run);

// Returns the study as the manifest keeps it.
Json study_record(const Study& study);

}  // namespace hysteron::experiments
