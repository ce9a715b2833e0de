// Compares a run with its repetition and lists what is the same and what is not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/verify/compared_numbers.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// The level at which the two agree.
enum class Agreement { bits, errors, none };

struct Repetition {
  bool has_state = false;               // positions and velocities were hashed
  bool same_state = false;              // they are the same, bit for bit
  bool bits_are_due = false;            // true if other bits are a failure
  double round_off = 0;                 // relative difference allowed between two builds
  ComparedNumbers metrics;              // metrics that both have
  ComparedNumbers energies;             // terms of the closing balance, "energy.kinetic"
  ComparedNumbers series;               // columns of tables, "metrics.csv:plate_force [N]"
  std::vector<std::string> missing;     // metrics no longer measured: a difference
  std::vector<std::string> unrecorded;  // results that the manifest lacks: a difference
  std::vector<std::string> lost;        // files of the manifest that its folder lacks: a difference
  std::vector<std::string> edited;      // changed tables that are not repeated: a difference
  int trimmed_files = 0;  // missing files of a folder that keeps only a part of its run: no difference
  int pictures = 0;
  std::vector<std::string> pictures_beyond;  // texts on differing pictures
  int data_files = 0;                        // fabric files and exported meshes
  std::vector<std::string> data_beyond;      // texts on differing data
  std::vector<std::string> data_otherwise;   // names of data that another program wrote differently

  Agreement agreement() const;
};

// Returns the relative round-off of a run.  Builds for other instruction sets, and other versions of the
// mathematical library, round the last bits differently, and a step ends wherever its forces balance to
// `newton-residual` of the load, which last bits decide.  Except for chaos and snaps, a tenth of that
// tolerance is enough, and runs without such steps stay within 1e-6.  (Measured on a dozen quick runs,
// without fused multiplication in the mathematical library and with the simulation built for AVX-512: at most
// 2e-5 for a tolerance of 1e-3, but 1.03e-4 of the integrator's share in `crease --quick`; 5e-8 for 1e-6.)
double round_off_bound(const Manifest& run);

// Returns the name of a term of the closing energy balance, as limits use it: "energy.kinetic".
std::string energy_name(const std::string& term);

// True if the metric of a run with these metrics is no duration and no error that --errors has stated.
bool is_compared(const std::string& metric, const Metrics& metrics);

// Compares numbers exactly, then with `limits` or else with the errors that --errors has stated, then with
// round-off; counts, texts and booleans exactly.  What only one run has is a difference, except what a newer
// program measures besides, and stated errors, which are not repeated.  The solver's iterations and residuals
// say nothing about the cloth and are only counted, unless they have a limit.  Durations are not compared.
//
// The same bits are required if one compiler's same instructions ran on the same device, and if `exact` is
// set.
Repetition compare_runs(const Manifest& recorded, const Manifest& now, const Limits& limits, bool exact);

// True if the file of a run is a picture of its cloth; plots depend on gnuplot's version and are not.
bool is_picture(const std::string& file);

// The files of a run that can be compared.  A folder with its page holds every picture, table, fabric file
// and mesh that its manifest lists; one without keeps only a part, which is compared.
struct ComparableFiles {
  std::vector<std::string> pictures;  // existing pictures (is_picture())
  std::vector<std::string> tables;    // series and others, except those of --errors, which are not repeated
  std::vector<std::string> data;      // fabric files and exported meshes
  std::vector<std::string> edited;    // tables that differ from their manifest's hash
  std::vector<std::string> lost;      // missing files of a folder with its page
  int trimmed = 0;                    // number of missing files of a folder without its page
};
ComparableFiles comparable_files(const Manifest& recorded, const std::filesystem::path& folder,
                                 bool with_pictures);
void compare_pictures(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                      const std::filesystem::path& now, const Limits& limits, Repetition& repetition);
// Compares data byte for byte if one program with the same bits wrote both; another may write them
// differently.
void compare_data(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                  const std::filesystem::path& now, bool same_program, Repetition& repetition);
// Records pictures, tables and data of the repetition that a manifest of the same program does not list.
void add_unlisted_files(const Manifest& recorded, const Manifest& now, bool with_pictures,
                        Repetition& repetition);

// Returns other differences between the two that may be the reason: program, device, keys of the scene; "" if
// there are none.
std::string reasons_between(const Manifest& recorded, const Manifest& now);

}  // namespace hysteron::experiments
