#include "sim/bending/laws/unused_parameters.h"

#include "sim/base/number_in.h"

namespace hysteron {
namespace {

std::string unused(const std::string& parameter, const std::string& why) {
  return "param " + parameter + " is not used: " + why;
}

// Says which memory a law has whose fabric has stops of its own.
std::string stops_text(const BendingParts& parts, const std::string& fabric) {
  return "the " + std::to_string(parts.stops.size()) + " stops of " + fabric +
         " are the law's memory; a fabric without stops leaves it to the "
         "parameter";
}

// Says why a number of the memory is not read; "" where it is.
std::string memory_text(const LawParams& choice, const std::string& parameter, const std::string& fabric) {
  const BendingParts& parts = choice.curve.parts;
  if (parameter != "memory" && parameter != "stops" && parameter != "stack") return "";
  if (!parts.stops.empty()) return stops_text(parts, fabric);
  if (choice.name != "prandtl") return "";
  if (parameter == "stops" && choice.stack)
    return "the law remembers by a stack of reversal points; --param memory=stops takes stops";
  if (parameter == "stack" && parts.set.on())
    return "the law of a fabric with a set (fabric.bending.set) remembers by stops";
  if (parameter == "stack" && parts.faces.on())
    return "the law of a fabric whose faces differ (fabric.back-bending, fabric.back-friction) remembers by "
           "stops";
  if (parameter == "stack" && !choice.stack)
    return "the law remembers by stops; --param memory=stack takes a stack of reversal points";
  return "";
}

std::string fatigue_text(const LawParams& choice, const std::string& parameter) {
  const bool follows = parameter == "fatigue.m-inf" || parameter == "fatigue.set";
  return follows && !choice.fatigue.on() ? "friction does not weaken without param fatigue.dc" : "";
}

bool takes_stops(const std::string& law) { return law == "prandtl" || law == "chapman"; }

std::string part_text(const std::string& part, const std::string& fabric, const std::string& law,
                      const std::string& laws) {
  return "fabric.bending." + part + " of " + fabric + " changes nothing under law " + law + ": " + laws +
         " it";
}

// Warns of the fabric's parts beyond b1, b2 and k0 that the law does not take.
std::vector<std::string> unused_part_warnings(const std::string& law, const BendingParts& parts, LawUse use,
                                              const std::string& fabric) {
  std::vector<std::string> warnings;
  if (const std::string of_weft = weft_stops_warning(law, parts, fabric);
      use == LawUse::cloth && !of_weft.empty())
    warnings.push_back(of_weft);
  if (!parts.branches.empty() && law != "chapman")
    warnings.push_back(part_text("branches", fabric, law, "chapman takes"));
  if (parts.set.on() && !takes_stops(law))
    warnings.push_back(part_text("set", fabric, law, "prandtl and chapman take"));
  if (parts.faces.on() && !has_faces(law))
    warnings.push_back(
        "fabric.back-bending = " + number_text(parts.faces.bending) +
        " and fabric.back-friction = " + number_text(parts.faces.friction) + " are not followed: law " + law +
        " bends both ways alike, with the means of both sides (prandtl and linear have sides)");
  return warnings;
}

}  // namespace

std::string weft_stops_warning(const std::string& law, const BendingParts& parts, const std::string& fabric) {
  if (parts.weft_stops.empty() || takes_stops(law)) return "";
  return part_text("stops.weft", fabric, law, "prandtl and chapman take");
}

std::vector<std::string> unused_parameter_warnings(const std::string& law, const VirginCurve& curve,
                                                   const LawParameters& given, LawUse use,
                                                   const std::string& fabric) {
  const LawParams choice = choose_law(law, curve, given, use);
  std::vector<std::string> warnings = unused_part_warnings(law, curve.parts, use, fabric);
  for (const auto& [parameter, text] : given)
    for (const std::string& why : {memory_text(choice, parameter, fabric), fatigue_text(choice, parameter)})
      if (!why.empty()) warnings.push_back(unused(parameter, why));
  return warnings;
}

}  // namespace hysteron
