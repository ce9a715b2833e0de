// Warns users of parameters of a law, and parts of a fabric, that change nothing beside the others;
// simulations, `law`, `kes`, `fit` and `fold.law-alone` share these warnings.
//
// A law's memory is one of three: the stops of its fabric, a number of stops (`stops`), or a stack of
// reversal points (`stack`).  Numbers of another memory than the law's own are not read.  Friction weakens
// where there is a `fatigue.dc`; without it the other parameters of fatigue are not read.
#pragma once

#include <string>
#include <vector>

#include "sim/bending/laws/law_parameters.h"

namespace hysteron {

// Returns a sentence for each of the given parameters that changes nothing, and for each part of the fabric
// beyond b1, b2 and k0 that the law does not take: a spectrum along weft, branches, a set.  `fabric` names
// the fabric of the curve; `use` decides on the law's memory where no parameter does.  Throws as
// choose_law().
std::vector<std::string> unused_parameter_warnings(const std::string& law, const VirginCurve& curve,
                                                   const LawParameters& given, LawUse use,
                                                   const std::string& fabric);

// Returns the sentence on a spectrum along weft that the law does not take, for experiments that bend cloth
// along weft; "" where it takes it, or there is none.
std::string weft_stops_warning(const std::string& law, const BendingParts& parts, const std::string& fabric);

}  // namespace hysteron
