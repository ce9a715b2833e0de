// Parameters of a law, and parts of a fabric, that change nothing beside the others: said to who gives them,
// by simulations, by `law`, `kes`, `fit` and `fold.law-alone` alike.
//
// A law's memory is one of three: the stops of its fabric, a number of stops (`stops`), or a stack of
// reversal points (`stack`).  Numbers of another memory than the law's own are not read.  Friction weakens
// where there is a `fatigue.dc`; without it the other parameters of fatigue are not read.
#pragma once

#include <string>
#include <vector>

#include "sim/bending/laws/law_parameters.h"

namespace hysteron {

// A sentence for each of the given parameters that changes nothing, and for what the fabric states beyond b1,
// b2 and k0 where the law does not take it: a spectrum along weft, branches, a set.  `fabric`: the name of
// the fabric whose curve it is; `use` decides on the law's memory where no parameter does.  Throws as
// choose_law().
std::vector<std::string> unused_parameter_warnings(const std::string& law, const VirginCurve& curve,
                                                   const LawParameters& given, LawUse use,
                                                   const std::string& fabric);

// The sentence on a spectrum along weft that the law does not take, for who bends cloth along weft; "" where
// it does, or there is none.
std::string weft_stops_warning(const std::string& law, const BendingParts& parts, const std::string& fabric);

}  // namespace hysteron
