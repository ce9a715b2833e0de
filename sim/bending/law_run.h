// One law alone, driven through a list of curvatures: what `hysteron law` and the fits stand on.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "sim/bending/law.h"

namespace hysteron {

// A parameter of a law is a number (`stops=8`) or a word (`memory=stack`).
using LawParameter = std::variant<double, std::string>;

struct LawRequest {
  std::string name = "prandtl";  // one of law_catalogue()
  VirginCurve curve;
  std::map<std::string, LawParameter> parameters;
};

// One accepted step: the curvature visited.  The first row starts from rest (K = 0, no history).
struct LawRow {
  double curvature = 0;  // [1/m]
};

// One value per row.
struct LawRun {
  std::vector<double> moment;      // [N]
  std::vector<double> tangent;     // dM/dK of the step [N m]
  std::vector<double> stored;      // recoverable energy [J/m^2]
  std::vector<double> dissipated;  // lost since rest [J/m^2]; `wong`: work of friction since rest
};

struct LawEntry {
  std::string name;
  std::string description;  // one line
  bool built;               // false: announced, asking for it is refused
};

// All laws of the interface in its order.
const std::vector<LawEntry>& law_catalogue();

// Drives the law through `rows` in double precision, D = 1.
// Parameters: prandtl: memory = stack (default) | stops, stack = 4|8|16|32|64 (default 64, reversal points
// kept), stops = 4|8|16|32 (default 8); wong: recovery = masing (default) | reversible. Throws Error::request
// for an unknown or unbuilt law and for unknown or impossible parameters.
LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows);

}  // namespace hysteron
