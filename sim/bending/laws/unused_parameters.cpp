#include "sim/bending/laws/unused_parameters.h"

namespace hysteron {
namespace {

std::string unused(const std::string& parameter, const std::string& why) {
  return "param " + parameter + " is not used: " + why;
}

// The memory of a law whose fabric has stops of its own.
std::string stops_text(const BendingParts& parts, const std::string& fabric) {
  return "the " + std::to_string(parts.stops.size()) + " stops of " + fabric +
         " are the law's memory; a fabric without stops leaves it to the "
         "parameter";
}

// Why a number of the memory is not read; "" where it is.
std::string memory_text(const LawChoice& choice, const std::string& parameter, const std::string& fabric) {
  const BendingParts& parts = choice.curve.parts;
  if (parameter != "memory" && parameter != "stops" && parameter != "stack") return "";
  if (!parts.stops.empty()) return stops_text(parts, fabric);
  if (choice.name != "prandtl") return "";
  if (parameter == "stops" && choice.stack)
    return "the law remembers by a stack of reversal points; --param memory=stops takes stops";
  if (parameter == "stack" && parts.set.on())
    return "the law of a fabric with a set (fabric.bending.set) remembers by stops";
  if (parameter == "stack" && !choice.stack)
    return "the law remembers by stops; --param memory=stack takes a stack of reversal points";
  return "";
}

std::string fatigue_text(const LawChoice& choice, const std::string& parameter) {
  const bool follows = parameter == "fatigue.m-inf" || parameter == "fatigue.set";
  return follows && !choice.fatigue.on() ? "friction does not weaken without param fatigue.dc" : "";
}

// What a fabric states beyond b1, b2 and k0 and the law does not take.
std::vector<std::string> unused_part_warnings(const std::string& law, const BendingParts& parts, LawUse use,
                                              const std::string& fabric) {
  const bool has_stops = law == "prandtl" || law == "chapman";
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& part, const std::string& laws) {
    warnings.push_back("fabric.bending." + part + " of " + fabric + " changes nothing under law " + law +
                       ": " + laws + " it");
  };
  if (use == LawUse::cloth && !parts.weft_stops.empty() && !has_stops)
    warn("stops.weft", "prandtl and chapman take");
  if (!parts.branches.empty() && law != "chapman") warn("branches", "chapman takes");
  if (parts.set.on() && !has_stops) warn("set", "prandtl and chapman take");
  return warnings;
}

}  // namespace

std::vector<std::string> unused_parameter_warnings(const std::string& law, const VirginCurve& curve,
                                                   const LawParameters& given, LawUse use,
                                                   const std::string& fabric) {
  const LawChoice choice = choose_law(law, curve, given, use);
  std::vector<std::string> warnings = unused_part_warnings(law, curve.parts, use, fabric);
  for (const auto& [parameter, text] : given)
    for (const std::string& why : {memory_text(choice, parameter, fabric), fatigue_text(choice, parameter)})
      if (!why.empty()) warnings.push_back(unused(parameter, why));
  return warnings;
}

}  // namespace hysteron
