// From the names in a LawChoice to a law as a type: each function calls visit(law) and returns true if the
// law is one of its group.  D = 1 (scalar, hinge) or 3 (tensor, shape; scalar laws run along four
// directions).
#pragma once

#include <cmath>
#include <utility>

#include "sim/bending/laws/bridson.h"
#include "sim/bending/laws/dahl.h"
#include "sim/bending/laws/fatigue.h"
#include "sim/bending/laws/flexion_spring.h"
#include "sim/bending/laws/four_directions.h"
#include "sim/bending/laws/gong.h"
#include "sim/bending/laws/grinspun_edit.h"
#include "sim/bending/laws/kim.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/bending/laws/linear.h"
#include "sim/bending/laws/narain.h"
#include "sim/bending/laws/obrien.h"
#include "sim/bending/laws/pabst.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/terzopoulos.h"
#include "sim/bending/laws/wong.h"

namespace hysteron {

template <int... n>
using Sizes = std::integer_sequence<int, n...>;
// Sizes of the memory of `prandtl` that exist: every one is a type of its own and takes its time to compile.
struct AloneMemory {
  using Stops = Sizes<4, 8, 16, 32>;
  using Depths = Sizes<4, 6, 8, 16, 32, 64>;
};
struct ClothMemory {
  using Stops = Sizes<4, 8, 16, 32>;
  using Depths = Sizes<4, 6, 8, 16>;
};
struct ClothFatigueMemory {
  using Stops = Sizes<8, 16>;
  using Depths = Sizes<8>;
};

// A scalar law for D components.
template <int D, class Law>
auto in_dimension(const Law& law) {
  if constexpr (D == Law::kDimension) {
    return law;
  } else {
    return FourDirections<Law>{law};
  }
}

template <class Real, int D, class Visit>
bool visit_memoryless(const LawChoice& c, Visit&& visit) {
  if (c.name == "linear") return visit(Linear<Real, D>::make(c.curve)), true;
  if (c.name == "bridson") return visit(Bridson<Real, D>::make(c.curve, c.height)), true;
  if (c.name == "spring") return visit(FlexionSpring<Real, D>::make(c.curve, c.height)), true;
  if (c.name == "pabst") return visit(Pabst<Real, D>::make(c.curve)), true;
  if (c.name == "grinspun-edit") return visit(GrinspunEdit<Real, D>::make(c.curve)), true;
  return false;
}

template <class Real, int D, class Visit>
bool visit_plastic(const LawChoice& c, Visit&& visit) {
  if (c.name == "terzopoulos") return visit(Terzopoulos<Real, D>::make(c.curve, c.tau)), true;
  if constexpr (D > 1) {  // a bounded set: scalar form only
    if (std::isfinite(c.max_set)) {
      return visit_plastic<Real, 1>(c, [&](const auto& law) { visit(in_dimension<D>(law)); });
    }
  }
  if (c.name == "obrien") return visit(Obrien<Real, D>::make(c.curve, c.yield, c.max_set)), true;
  if (c.name == "kim")
    return visit(Kim<Real, D>::make(c.curve, c.yield, c.max_set, c.weakening, c.tau)), true;
  if (c.name == "narain") return visit(Narain<Real, D>::make(c.curve, c.yield, c.max_set, c.weakening)), true;
  if (c.name == "gong") return visit(in_dimension<D>(Gong<Real>::make(c.curve, c.yield, c.tau))), true;
  return false;
}

template <class Real, class Visit, int... n>
void visit_stack(int depth, const VirginCurve& curve, Visit&& visit, Sizes<n...>) {
  (void)((depth == n && (visit(PrandtlStack<Real, n>::make(curve)), true)) || ...);
}
template <class Real, int D, class Visit, int... n>
void visit_stops(int count, const VirginCurve& curve, Visit&& visit, Sizes<n...>) {
  (void)((count == n && (visit(PrandtlStops<Real, D, n>::make(curve)), true)) || ...);
}

// `visit` gets the law of a fabric `curve`: in D components, or a scalar one that in_dimension() completes.
template <class Real, int D, class Memory, class Visit>
bool visit_hysteretic(const LawChoice& c, const VirginCurve& curve, Visit&& visit) {
  const Recovery recovery = c.reversible ? Recovery::kReversible : Recovery::kMasing;
  if (c.name == "bilinear") return visit(make_bilinear<Real, D>(curve)), true;
  if (c.name == "wong") return visit(Wong<Real>::make(curve, recovery)), true;
  if (c.name != "prandtl") return false;
  if (c.stack)
    visit_stack<Real>(c.depth, curve, visit, typename Memory::Depths{});
  else
    visit_stops<Real, D>(c.stops, curve, visit, typename Memory::Stops{});
  return true;
}

template <class Real, int D, class Memory, class Visit>
bool visit_friction(const LawChoice& c, Visit&& visit) {
  if (c.fatigue.on()) return false;
  if (c.name == "dahl") return visit(Dahl<Real, D>::make(c.curve)), true;
  return visit_hysteretic<Real, D, Memory>(c, c.curve, [&](const auto& law) { visit(in_dimension<D>(law)); });
}

template <class Real, int D, class Memory, class Visit>
bool visit_fatigue(const LawChoice& c, Visit&& visit) {
  if (!c.fatigue.on()) return false;
  const VirginCurve friction{c.curve.b1 - c.curve.b2, 0, c.curve.k0};
  return visit_hysteretic<Real, D, Memory>(c, friction, [&]<class Law>(const Law& law) {
    visit(in_dimension<D>(Fatigue<Law>::make(c.curve, c.fatigue, law)));
  });
}

}  // namespace hysteron
