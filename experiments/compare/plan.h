// Plans the columns of a comparison and their requests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/compare/matching.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {

// Names the quantity that is shown of the difference between a column and the one that compare.to names.
enum class Difference { picture, curvature };
constexpr std::array<const char*, 2> names(Difference) { return {"picture", "curvature"}; }

struct CompareParams {
  std::string laws, fabrics, integrators;
  std::string to;  // column that others differ from; "": no such rows
  Difference difference = Difference::picture;
  int rows = 4;
  Numbers times;        // times of the rows [s]; empty: spread evenly
  std::string metrics;  // shown metrics; empty: all in the table, the experiment's own on the page
  bool no_outlines = false;
  int jobs = 0, batch = 1;
  Match match = Match::energy;
  double match_curvature = 100;  // KES tester's reading point [1/m]
  std::string video = "none";
  double video_size = 4;     // largest file of each film [MB]
  std::string title, names;  // "": the page's own
  std::string tune, tune_metric;
};

// Returns "crease, drape, ..., or a scene".
std::string compared_experiments();

// Returns the line for the experiment itself: lists become its --law, --fabric and --integrator.
CommandLine line_of_columns(const CommandLine& line, const CompareParams& choice);

struct Plan {
  std::vector<ChildRun> columns;
  std::vector<double> scales;
  std::string reference;       // law that stiffness is matched to
  bool has_reference = false;  // a column has this law
  bool has_faces = false;      // a column's fabric has different rigidities to back and face
  std::size_t laws = 0;        // number of different laws
  int to = -1;                 // index of the column that is subtracted, -1: none
  std::string varied;          // "law" if columns differ by it alone
};

// Returns a column per variant of that line, in OUT/<name>/.  Throws Error::invalid_input if the column to
// subtract is none of them.
Plan comparison_plan(const CommandLine& inner, const std::vector<Variant>& variants,
                     const CompareParams& choice, const std::filesystem::path& out);

// Throws Error::invalid_input for a time [s] after the end of the longest run of the columns, as their scenes
// have it.
void check_times(const std::vector<double>& times, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
