// `hysteron law`: one law alone, from a list of curvatures to moments and energies.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/bending/law_run.h"

namespace hysteron::experiments {

struct LawOptions {
  std::string law = "prandtl";
  VirginCurve curve{};                  // --b1, --b2 [N m], --k0 [1/m]
  std::vector<std::string> parameters;  // --param, each "name=value"
  std::filesystem::path in;             // columns `curvature [1/m]`, optional `time [s]`, `edit`
  std::filesystem::path out;            // curvature, moment, tangent, stored, dissipated (cumulative)
};

// "name=value" as a parameter of a law; throws Error::request if it is not of that form.
std::pair<std::string, LawParameter> parse_parameter(const std::string& text);

// Reads, runs, writes; returns 0.  The first row is the first curvature visited from rest, every row is one
// accepted step.  `time` must not fall; the laws built so far depend neither on it nor on `edit`.
int run_law_command(const LawOptions& options);

}  // namespace hysteron::experiments
