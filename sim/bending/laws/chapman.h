// Elasticity, friction and relaxing branches side by side: the theory of wrinkle recovery in which a fold's
// moment relaxes while it is held and its angle comes back in time after release, as far as friction lets it
// (measured_law.h).  Friction is the fabric's stops, or those that b1, b2 and k0 make; the branches are the
// fabric's, and a fabric without branches has elasticity and friction alone.
#pragma once

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/measured_law.h"

namespace hysteron {

struct ChapmanLaw {
  static constexpr const char* kName = "chapman";
  static constexpr const char* kMeaning =
      "elastic, friction and relaxing branches: wrinkles recover in time (after Chapman 1975)";
  static constexpr LawFamily kFamily = LawFamily::hysteretic;
  static constexpr bool kFrictionBesideB2 = true;
  static std::vector<LawParameter> parameters() { return {law_parameter::stops()}; }

  static bool takes_parts(const LawParams&) { return true; }
  static RelaxingBranches branches(const LawParams& c) { return c.curve.parts.branches; }
};

}  // namespace hysteron
