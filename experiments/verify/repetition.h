// A run beside its repetition: what is the same, and what is not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/verify/compared_numbers.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// How far the two agree.
enum class Agreement { bits, errors, none };

struct Repetition {
  bool has_state = false;               // positions and velocities were hashed
  bool same_state = false;              // and are the same, bit for bit
  bool bits_are_due = false;            // other bits are a failure
  double round_off = 0;                 // what may lie between two builds, of a number's size
  ComparedNumbers metrics;              // that both have
  ComparedNumbers energies;             // terms of the closing balance, "energy.kinetic"
  ComparedNumbers series;               // columns of tables, "metrics.csv:plate_force [N]"
  std::vector<std::string> missing;     // that are no longer measured: a difference
  std::vector<std::string> unrecorded;  // that are measured, and the manifest does not hold: likewise
  std::vector<std::string> lost;        // files of the manifest that its folder lacks: likewise
  std::vector<std::string> edited;      // tables that are not repeated and not as they were written: likewise
  int trimmed_files = 0;                // those of a folder that keeps only a part of its run: no difference
  int pictures = 0;
  std::vector<std::string> pictures_beyond;  // in words
  int data_files = 0;                        // fabric files and exported meshes
  std::vector<std::string> data_beyond;      // in words
  std::vector<std::string> data_otherwise;   // that another program has written in another way

  Agreement agreement() const;
};

// Builds for other instruction sets, and other versions of the mathematical library, round the last bits
// differently.  What becomes of that: a step ends wherever its forces balance to `newton-residual` of the
// load, and last bits decide where.  Short of chaos and of snaps a tenth of that tolerance is
// enough, and runs without such steps stay within 1e-6.  (Measured on a dozen quick runs, without fused
// multiplication in the mathematical library and with the simulation built for AVX-512: at most 2e-5 where
// the tolerance is 1e-3, but 1.03e-4 of the integrator's share in `crease --quick`; 5e-8 where it is 1e-6.)
double round_off_bound(const Manifest& run);

// The name of a term of the closing energy balance, as limits have it: "energy.kinetic".
std::string energy_name(const std::string& term);

// Whether the metric of a run with these metrics is no duration and no error that --errors has stated.
bool is_compared(const std::string& metric, const Metrics& metrics);

// Numbers are compared exactly, then with the limits of `limits` or else the errors that --errors has stated
// of them, then with round-off; counts, texts and truths exactly.  What only one of them has is a difference,
// but for what a newer program measures besides, and for the errors themselves, which are not repeated.  How
// often a solver iterated, and what it left over, says nothing of the cloth and is only counted, unless a
// limit is set on it.  Durations are not compared.
//
// The same bits are due where one compiler's same instructions ran on the same device, and where `exact` asks
// for them.
Repetition compare_runs(const Manifest& recorded, const Manifest& now, const Limits& limits, bool exact);

// Whether the file of a run is a picture of its cloth: plots are none, since they belong to gnuplot's
// version.
bool is_picture(const std::string& file);

// A run's folder holds every picture, table, fabric file and mesh that its manifest lists, as long as its
// page stands in it. One without its page keeps only a part, which is compared.
struct ComparableFiles {
  std::vector<std::string> pictures;  // that are there (is_picture())
  std::vector<std::string> tables;    // series and others, but for those of --errors, which are not repeated
  std::vector<std::string> data;      // fabric files and exported meshes
  std::vector<std::string> edited;    // tables that are not as their manifest's hash has them
  std::vector<std::string> lost;      // that are not there, although the page is
  int trimmed = 0;                    // that are not there, and the page is not either
};
ComparableFiles comparable_files(const Manifest& recorded, const std::filesystem::path& folder,
                                 bool with_pictures);
void compare_pictures(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                      const std::filesystem::path& now, const Limits& limits, Repetition& repetition);
// Byte for byte where one program of the same bits wrote both; another may write them in another way.
void compare_data(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                  const std::filesystem::path& now, bool same_program, Repetition& repetition);
// Pictures, tables and data of the repetition that a manifest of the same program does not list.
void add_unlisted_files(const Manifest& recorded, const Manifest& now, bool with_pictures,
                        Repetition& repetition);

// What else differs between the two and may be why: program, device, keys of the scene; "" for nothing.
std::string reasons_between(const Manifest& recorded, const Manifest& now);

}  // namespace hysteron::experiments
