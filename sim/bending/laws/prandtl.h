// The Prandtl-Ishlinskii law in its two forms, stops (prandtl_stops.h) or a stack of reversals
// (prandtl_stack.h), and for fabrics with stops of their own, or a set (measured_law.h).
//
// Every memory size is a type of its own and takes its time to compile.
#pragma once

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/measured_law.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"

namespace hysteron {

struct PrandtlLaw {
  static constexpr const char* kName = "prandtl";
  static constexpr const char* kMeaning =
      "quadratic loop, all reversals remembered (Prandtl-Ishlinskii; Iwan 1966)";
  static constexpr LawFamily kFamily = LawFamily::hysteretic;
  static constexpr bool kFrictionBesideB2 = true, kHasFaces = true;
  static std::vector<LawParameter> parameters() {
    return law_parameter::with_fatigue(
        {{"memory", [](const ParameterText& t, LawParams& c) { c.stack = t.is_second("stops", "stack"); }},
         law_parameter::stops(),
         {"stack", [](const ParameterText& t, LawParams& c) {
            c.depth = t.use == LawUse::alone ? t.allowed_integer({4, 6, 8, 16, 32, 64})
                                             : t.allowed_integer({4, 6, 8, 16});
          }}});
  }
  static void check(const LawParams& c, LawUse use) {
    const BendingParts& parts = c.curve.parts;
    if (c.fatigue.on() && (parts.set.on() || !parts.weft_stops.empty()))
      c.refuse("fatigue.dc",
               "fatigue.dc goes with friction along warp alone: not with stops along weft, nor with a set");
    if (c.fatigue.on() && parts.stops.size() > kFewStops)
      c.refuse("fatigue.dc", "fatigue.dc goes with " + std::to_string(kFewStops) +
                                 " stops of a fabric at most, not with " +
                                 std::to_string(parts.stops.size()));
    if (parts.faces.on()) return check_faces(c, use);
    if (!c.fatigue.on() || use != LawUse::cloth || !parts.stops.empty()) return;
    if (c.stack && c.depth != 8) c.refuse("stack", "stack = " + shown(c.depth) + " must be 8 with fatigue");
    if (!c.stack && c.stops != 8 && c.stops != 16)
      c.refuse("stops", "stops = " + shown(c.stops) + " must be 8 or 16 with fatigue");
  }

  // The fabric's own stops are the law's memory, whatever `memory` says.
  static bool takes_parts(const LawParams& c) {
    return !c.curve.parts.stops.empty() || c.curve.parts.set.on();
  }
  static RelaxingBranches branches(const LawParams&) { return {}; }

  // Visits friction alone, which weakens: calls visit(law).
  template <class Real, int D, class Memory, class Visit>
  static void visit_friction(const LawParams& c, const Visit& visit) {
    if (c.curve.parts.stops.empty())
      PrandtlLaw::visit<Real, D, Memory>(c, visit);
    else
      visit(SpectrumStops<Real, D, kFewStops>::make(0, c.curve.parts.stops, {}));
  }

  template <class Real, int D, class Memory, class Visit>
  static void visit(const LawParams& c, const Visit& visit) {
    if (c.stack)
      visit_depth<Real>(c, visit, typename Memory::Depths{});
    else
      visit_stops<Real, D>(c, visit, typename Memory::Stops{});
  }

 private:
  static void check_faces(const LawParams& c, LawUse use) {
    const BendingParts& parts = c.curve.parts;
    const auto refuse = [&](const char* key, const std::string& what) {
      c.refuse(key, what + " where fabric.back-bending or fabric.back-friction is not 1");
    };
    if (c.fatigue.on())
      refuse("fatigue.dc", "no fatigue goes with faces that differ: fatigue.dc must be left out");
    if (parts.set.on() || !parts.weft_stops.empty())
      refuse("stops", "neither a set nor stops along weft go with faces that differ: they must be left out");
    const int most = use == LawUse::alone ? kMaxStops : kFewStops;
    if (static_cast<int>(parts.stops.size()) > most)
      refuse("stops", "a fabric has " + std::to_string(parts.stops.size()) + " stops and must have at most " +
                          std::to_string(most));
    if (!(c.curve.face_width() <= kMostFaceWidth))
      c.refuse("stops", "the friction moments of face and back differ by " +
                            shown(c.curve.friction_moment() * std::abs(parts.faces.friction - 1)) +
                            " N, too much beside b2");
    if (!parts.stops.empty()) return;
    if (use == LawUse::cloth && c.stack) refuse("memory", "memory = stack must be stops");
    if (!c.stack && c.stops != kFewStops && c.stops != most)
      refuse("stops", "stops = " + shown(c.stops) + " must be " + shown(kFewStops) +
                          (most != kFewStops ? " or " + shown(most) : ""));
  }

  template <class Real, class Visit, int... n>
  static void visit_depth(const LawParams& c, const Visit& visit, Sizes<n...>) {
    (void)((c.depth == n && (visit(PrandtlStack<Real, n>::make(c.curve)), true)) || ...);
  }
  template <class Real, int D, class Visit, int... n>
  static void visit_stops(const LawParams& c, const Visit& visit, Sizes<n...>) {
    (void)((c.stops == n && (visit(PrandtlStops<Real, D, n>::make(c.curve)), true)) || ...);
  }
};

}  // namespace hysteron
