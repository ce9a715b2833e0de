// A study: one experiment, what all of its runs are asked for, and the axes along which they differ.
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
  std::string key;                  // of a scene or the experiment: "fabric.k0", "param.stack"
  std::string unit;                 // of its values, "" for texts
  std::vector<std::string> values;  // as flags take them, in the order in which they are run
  bool numeric = false;             // all of them are numbers
  bool logarithmic = false;         // in plots
  bool sampled = false;             // together with the other axes that are, not on a grid
};

// The axis of repeated draws.
inline constexpr const char* kSeedKey = "seed";
bool is_seed(const StudyAxis& axis);

struct StudyRun {
  std::string name;                 // of its folder: "k0=12.5,law=dahl,seed=3"
  std::vector<std::string> values;  // one of each axis
};

struct Study {
  std::string file;  // or a sweep's manifest
  std::string name;  // as it was called
  std::string experiment;
  std::vector<Flag> shared;  // keys that all runs have in common
  std::vector<StudyAxis> axes;
  std::vector<std::string> metrics;  // that pages show; empty: the experiment's headlines
  std::string metrics_place;         // "study.toml:2"
  JobResources resources;            // of a job on a cluster
  int runs_a_job = 1;                // one after the other
  std::vector<StudyRun> runs;
};

// Of a file, of assets/studies, or, by its manifest, of a sweep: all but its [resources].  Throws
// Error::system if it cannot be read, Error::invalid_input with file, line, key and what is allowed for
// everything that a run would refuse of a single key.
Study read_study(const std::string& name_or_file);

// Every combination of the axes' values, the last axis first; sampled axes go together.  Names are those of
// files everywhere and differ from each other.
std::vector<StudyRun> runs_on_axes(const std::vector<StudyAxis>& axes);

// `n` numbers in [0, 1) of each of `axes`, by axis: every n-th part of an axis is drawn from once, in an
// order of its own (McKay, Beckman & Conover 1979, Technometrics 21:239).  The same seed gives the same
// numbers on every machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint64_t seed);

// The flag that gives the key of a study this value: {"param", "stack=8"} for "param.stack".
Flag flag_of(const std::string& key, const std::string& value);
// What the run is asked for.
CommandLine run_command_line(const Study& study, const StudyRun& run);

// What the manifest keeps of it.
Json study_record(const Study& study);

}  // namespace hysteron::experiments
