// `hysteron law`: one law alone, from a list of curvatures to moments and energies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/bending/laws/law_run.h"

namespace hysteron::experiments {

struct LawOptions {
  std::string law = "prandtl";
  VirginCurve curve{};        // --b1, --b2 [N m], --k0 [1/m]
  LawParameters parameters;   // --param name=value
  std::filesystem::path in;   // columns `curvature [1/m]`, optional `time [s]`, `edit`
  std::filesystem::path out;  // curvature, moment, tangent, stored, dissipated (cumulative)
};

// Reads, runs, writes; returns 0.  The first row is the first curvature visited from rest, every row is one
// accepted step, which takes the difference of the two times (the first row: 0 s), or 1 s where there is no
// `time`; it must not fall.  `edit` = 1 sets the rest curvature to that of the row (grinspun-edit; others
// ignore it).  Prints the reversals by recovery case, and the residual curvature after the last row.
int run_law_command(const LawOptions& options);

}  // namespace hysteron::experiments
