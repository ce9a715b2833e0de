// Each law's header describes its law: the name, a line for the list of laws, its parameters, and how it is
// made from them.
//
//   struct SomeLaw {
//     static constexpr const char* kName = ...;     // of the law in scenes and flags
//     static constexpr const char* kMeaning = ...;  // one line
//     static constexpr LawFamily kFamily = ...;     // by which pages order and colour it
//     template <class Real, int D>                  // D components, or a scalar law whatever D is
//     static Some<Real, D> make(const LawParams&);
//   };
//
// It may also have
//
//     // Whether M = b2 K + F, F a friction that knows nothing of b2: then elasticity may have directions of
//     its
//     // own (CurvatureOperator::elastic).
//     static constexpr bool kFrictionBesideB2 = true;
//     // Whether it follows faces that differ (faces.h); others have the mean of both.
//     static constexpr bool kHasFaces = true;
//     // The parameters that the law takes, in the order of LawParams.
//     static std::vector<LawParameter> parameters();
//     // Where a parameter's default is the law's own.
//     static void set_defaults(LawParams&);
//     // Refuses what no parameter shows alone.
//     static void check(const LawParams&, LawUse);
//     // Whether on the tensor the law of D = 1 is run along four directions.
//     static bool runs_along_directions(const LawParams&);
//     // In place of make(), where parameters decide on the type of law: calls visit(law).
//     template <class Real, int D, class Memory, class Visit>
//     static void visit(const LawParams&, const Visit& visit);
//     // Of a law that can weaken, where the fabric's parts decide on its friction: calls visit(law).
//     template <class Real, int D, class Memory, class Visit>
//     static void visit_friction(const LawParams&, const Visit& visit);
//     // Of a law of a group with kStops: whether what the fabric has beyond three numbers makes it
//     // another type of law (measured_law.h), and the branches that relax beside its stops.
//     static bool takes_parts(const LawParams&);
//     static RelaxingBranches branches(const LawParams&);
#pragma once

#include <cmath>
#include <utility>

#include "sim/bending/laws/law_parameters.h"

namespace hysteron {

template <int... n>
using Sizes = std::integer_sequence<int, n...>;

template <class... Laws>
struct LawList {};

template <class Law>
concept LawDescription = requires {
  std::string(Law::kName) + Law::kMeaning;
  LawFamily(Law::kFamily);
};

// The text of a parameter, from which a number is read; Error::invalid_input refuses what is not allowed.
struct ParameterText {
  std::string law, key, text;
  LawUse use;

  [[noreturn]] void refuse(const std::string& allowed) const;
  double number(double low, double high, const std::string& allowed) const;
  double positive(const std::string& unit) const;
  double not_negative(const std::string& unit) const;
  int allowed_integer(const std::vector<int>& allowed) const;
  bool is_second(const std::string& first, const std::string& second) const;
};

// These parameters are shared by several laws.
namespace law_parameter {
LawParameter yield();
LawParameter max_set();
LawParameter weakening();
LawParameter height();
LawParameter tau();
LawParameter stops();
std::vector<LawParameter> with_fatigue(std::vector<LawParameter> own);
}  // namespace law_parameter

// Writes a number as messages show it.
std::string shown(double x);

template <LawDescription Law>
LawEntry law_entry() {
  LawEntry entry{Law::kName, Law::kMeaning};
  entry.family = Law::kFamily;
  if constexpr (requires { Law::kFrictionBesideB2; }) entry.has_friction_beside_b2 = Law::kFrictionBesideB2;
  if constexpr (requires { Law::kHasFaces; }) entry.has_faces = Law::kHasFaces;
  if constexpr (requires { Law::parameters(); }) entry.parameters = Law::parameters();
  if constexpr (requires(LawParams & c) { Law::set_defaults(c); }) entry.set_defaults = Law::set_defaults;
  if constexpr (requires(const LawParams& c) { Law::check(c, LawUse::cloth); }) entry.check = Law::check;
  return entry;
}

template <class... Laws>
std::vector<LawEntry> law_entries(LawList<Laws...>) {
  return {law_entry<Laws>()...};
}

}  // namespace hysteron
