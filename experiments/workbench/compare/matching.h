// Laws of equal stiffness: what a comparison has to agree on before it compares anything else.
#pragma once

#include <array>

#include "sim/bending/laws/law_run.h"

namespace hysteron::experiments {

enum class Match {
  fabric,        // each law makes of b1, b2 and k0 what its own definition says; nothing is changed
  small_strain,  // equal slopes of the moment at rest
  energy,        // equal work to bend from flat to a given curvature
};
constexpr std::array<const char*, 3> names(Match) { return {"fabric", "small-strain", "energy"}; }

// Every stiffness in them multiplied: of stops, branches and set; no threshold and no time.
BendingParts stiffened(BendingParts parts, double scale);

// The number by which b1, b2 and all stiffnesses beyond them of `law` have to be multiplied (k0 stays) so
// that it is as stiff as `reference`; `curvature` is that of Match::energy [1/m], reached in one second by
// laws that take time. Where faces differ both measures are the means of bends to face and back.
// Error::invalid_input as run_law(), or if no number makes them equal to 1e-9.
double matching_scale(const LawRequest& law, const LawRequest& reference, Match match, double curvature);

// Work to bend from flat to `curvature`, to the back where it is < 0, stored or lost [J/m^2].
double bending_work(const LawRequest& law, double curvature);

}  // namespace hysteron::experiments
