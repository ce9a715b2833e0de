// Turns a LawParams into a law as a type: each function calls visit(law) and returns true if the law is in
// its list.  D = 1 is scalar (hinge), D = 3 the tensor (shape; scalar laws run along four directions).
#pragma once

#include <type_traits>

#include "sim/bending/laws/every_law.h"
#include "sim/bending/laws/faces.h"
#include "sim/bending/laws/fatigue.h"
#include "sim/bending/laws/four_directions.h"
#include "sim/bending/laws/measured_law.h"

namespace hysteron {

// The memory sizes of `prandtl` that exist: each is a type of its own and takes its time to compile.
struct LawMemorySizes {
  using Stops = Sizes<4, 8, 16, 32>;
  using Depths = Sizes<4, 6, 8, 16, 32, 64>;
  using Fatigued = LawMemorySizes;
  using Faced = Sizes<kFewStops, kMaxStops>;
};
struct FatiguedClothMemory {
  using Stops = Sizes<8, 16>;
  using Depths = Sizes<8>;
};
struct ClothMemory {
  using Stops = Sizes<4, 8, 16, 32>;
  using Depths = Sizes<4, 6, 8, 16>;
  using Fatigued = FatiguedClothMemory;
  using Faced = Sizes<kFewStops>;
};

// Makes a scalar law act on D components.
template <int D, MomentCurvatureLaw Law>
auto in_dimension(const Law& law) {
  if constexpr (D == Law::kDimension) {
    return law;
  } else {
    return FourDirections<Law>{law};
  }
}

// Calls visit() with the law in D components, or with a scalar one that in_dimension() completes.
template <LawDescription Law, class Real, int D, class Memory, class Visit>
void visit_made(const LawParams& c, const Visit& visit) {
  if constexpr (requires { Law::template make<Real, D>(c); })
    visit(Law::template make<Real, D>(c));
  else
    Law::template visit<Real, D, Memory>(c, visit);
}

template <LawDescription Law, class Real, int D, class Memory, class Visit>
void visit_in_dimension(const LawParams& c, const Visit& visit) {
  const auto complete = [&](const auto& law) { visit(in_dimension<D>(law)); };
  if constexpr (D > 1 && requires { Law::runs_along_directions(c); }) {
    if (Law::runs_along_directions(c)) return visit_made<Law, Real, 1, Memory>(c, complete);
  }
  visit_made<Law, Real, D, Memory>(c, complete);
}

// Makes the same law with friction that weakens, for a fabric without its straight branch.
template <LawDescription Law, class Real, int D, class Memory, class Visit>
void visit_fatigued(const LawParams& c, const Visit& visit) {
  LawParams friction = c;
  friction.curve = {c.curve.b1 - c.curve.b2, 0, c.curve.k0, {c.curve.parts.stops, {}, {}, {}, {}}};
  const auto weaken = [&]<class Friction>(const Friction& law) {
    visit(in_dimension<D>(Fatigue<Friction>::make(c.curve, c.fatigue, law)));
  };
  if constexpr (requires { Law::template visit_friction<Real, D, Memory>(friction, weaken); })
    Law::template visit_friction<Real, D, Memory>(friction, weaken);
  else
    visit_made<Law, Real, D, Memory>(friction, weaken);
}

// Makes the law with faces that differ, with as many stops as the fabric or the law's memory needs, none if
// the law has no friction.
template <LawDescription Law, class Real, int D, class Visit, int... n>
void visit_faced(const LawParams& c, const Visit& visit, Sizes<n...>) {
  constexpr bool kFriction = requires { Law::kFrictionBesideB2; };
  VirginCurve curve = c.curve;
  if (!kFriction) curve.b1 = curve.b2, curve.parts.stops = {};
  const bool few = !kFriction || (curve.parts.stops.empty() ? !c.stack && c.stops <= kFewStops
                                                            : curve.parts.stops.size() <= kFewStops);
  const int size = few ? kFewStops : kMaxStops;
  (void)((size == n && (visit(WithFaces<Real, D, n>::make(curve)), true)) || ...);
}

// Do the fabric's parts beyond b1, b2 and k0 make the law another type?
template <LawDescription Law>
bool takes_parts(const LawParams& c) {
  if constexpr (requires { Law::takes_parts(c); })
    return Law::takes_parts(c);
  else
    return false;
}

// Visits the law if c names it and it belongs to the group (every_law.h): laws of FatigueLaws weaken, those
// of FacesLaws have faces that differ, those of groups with kStops take a fabric's parts if the group has
// room for their stops and branches, and the others take three numbers alone.
template <LawDescription Law, class Group, class Real, int D, class Memory, class Visit>
bool visit_in_group(const LawParams& c, const Visit& visit) {
  constexpr bool kWeakens = std::is_same_v<Group, FatigueLaws>;
  constexpr bool kFaced = std::is_same_v<Group, FacesLaws>;
  if (c.name != Law::kName || c.fatigue.on() != kWeakens || c.curve.parts.faces.on() != kFaced) return false;
  if constexpr (kFaced) {
    visit_faced<Law, Real, D>(c, visit, typename Memory::Faced{});
    return true;
  } else if constexpr (kWeakens) {
    visit_fatigued<Law, Real, D, typename Memory::Fatigued>(c, visit);
    return true;
  } else if constexpr (requires { Group::kStops; }) {
    return takes_parts<Law>(c) && visit_measured<Real, D, Group>(c, Law::branches(c), visit);
  } else {
    if (takes_parts<Law>(c)) return false;
    visit_in_dimension<Law, Real, D, Memory>(c, visit);
    return true;
  }
}

template <class Group, class Real, int D, class Memory, class Visit, class... Laws>
bool visit_laws(LawList<Laws...>, const LawParams& c, const Visit& visit) {
  return (visit_in_group<Laws, Group, Real, D, Memory>(c, visit) || ...);
}
template <class Group, class Real, int D, class Memory, class Visit>
bool visit_group(const LawParams& c, const Visit& visit) {
  return visit_laws<Group, Real, D, Memory>(Group{}, c, visit);
}

// Tries every group.
template <class Real, int D, class Memory, class Visit, class... Groups>
bool visit_groups(LawList<Groups...>, const LawParams& c, const Visit& visit) {
  return (visit_group<Groups, Real, D, Memory>(c, visit) || ...);
}

}  // namespace hysteron
