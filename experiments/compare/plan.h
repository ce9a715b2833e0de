// The columns of a comparison: what each of them is asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/compare/matching.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {

struct CompareChoice {
  std::string laws, fabrics, integrators;
  std::string to;  // column that others differ from; "": no such rows
  std::string difference = "picture";
  int rows = 4;
  Numbers times;        // of the rows [s]; empty: spread evenly
  std::string metrics;  // that are shown; empty: all in the table, the experiment's own on the page
  bool no_outlines = false;
  int jobs = 0, batch = 1;
  Match match = Match::energy;
  double match_curvature = 100;  // [1/m], the KES tester's reading point
  std::string video = "none";
  double video_size = 4;     // of each film's file, at most [MB]
  std::string title, names;  // "": the page's own
  std::string tune, tune_metric;
};

// "crease, drape, ..., or a scene".
std::string compared_experiments();

// The line as the experiment itself would get it: lists become its --law, --fabric and --integrator.
CommandLine line_of_columns(const CommandLine& line, const CompareChoice& choice);

struct Plan {
  std::vector<ChildRun> columns;
  std::vector<double> scales;
  std::string reference;       // law that stiffness is matched to
  bool has_reference = false;  // a column has it
  bool has_faces = false;      // a column's fabric bends otherwise to its back than to its face
  std::size_t laws = 0;        // different ones
  int to = -1;                 // the column that is subtracted, -1: none
  std::string varied;          // "law", where columns differ by it alone
};

// A column for each variant of that line, in OUT/<name>/.  Throws Error::invalid_input if the column to
// subtract is none of them.
Plan comparison_plan(const CommandLine& inner, const std::vector<Variant>& variants,
                     const CompareChoice& choice, const std::filesystem::path& out);

// Throws Error::invalid_input for a time [s] after the end of the longest run of the columns, as their scenes
// have it.
void check_times(const std::vector<double>& times, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
