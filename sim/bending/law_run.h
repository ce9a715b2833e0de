// One law alone, driven through a list of curvatures: what `hysteron law` and the fits stand on.
#pragma once

#include <string>
#include <vector>

#include "sim/bending/law_parameters.h"

namespace hysteron {

struct LawRequest {
  std::string name = "prandtl";  // one of law_catalogue()
  VirginCurve curve;
  LawParameters parameters;
};

// One accepted step.  The first row starts from rest (K = 0, no history).
struct LawRow {
  double curvature = 0;  // [1/m]
  double seconds = 1;    // time that the step takes [s]
  bool edit = false;     // after the step the rest curvature is set to the current one (grinspun-edit)
};

// One value per row.
struct LawRun {
  std::vector<double> moment;      // [N]
  std::vector<double> tangent;     // dM/dK of the step [N m]
  std::vector<double> stored;      // recoverable energy [J/m^2]
  std::vector<double> dissipated;  // lost since rest [J/m^2]; `wong`: work of friction since rest
};

// Drives the law through `rows` in double precision, D = 1; parameters as in choose_law() for a law alone.
// Laws that cannot be edited ignore `edit`.  Throws Error::request as choose_law() does.
LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows);

}  // namespace hysteron
