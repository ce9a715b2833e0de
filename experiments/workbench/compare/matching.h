// Scales laws to equal stiffness, which a comparison needs before it compares anything else.
#pragma once

#include <array>

#include "sim/bending/laws/law_run.h"

namespace hysteron::experiments {

enum class Match {
  fabric,        // nothing is scaled: each law uses b1, b2 and k0 by its own definition
  small_strain,  // equal slopes of the moment at rest
  energy,        // equal work to bend from flat to a given curvature
};
constexpr std::array<const char*, 3> names(Match) { return {"fabric", "small-strain", "energy"}; }

// Returns the parts with every stiffness of stops, branches and set multiplied; no threshold and no time.
BendingParts stiffened(BendingParts parts, double scale);

// Returns the factor of b1, b2 and all further stiffnesses of `law` (k0 stays) that makes it as stiff as
// `reference`; `curvature` is that of Match::energy [1/m], reached in one second by laws that depend on time.
// If faces differ both measures are the means of bends to face and back.  Throws Error::invalid_input as
// run_law() does, or if no factor makes them equal to 1e-9.
double matching_scale(const LawRequest& law, const LawRequest& reference, Match match, double curvature);

// Returns the work to bend from flat to `curvature` [1/m], to the back if it is < 0, stored or lost [J/m^2].
double bending_work(const LawRequest& law, double curvature);

}  // namespace hysteron::experiments
