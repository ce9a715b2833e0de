// Lists every law, and the groups by which their loops are compiled (sim/CMakeLists.txt).  A new law needs an
// include here and its name in EveryLaw and in its groups.
#pragma once

#include "sim/bending/laws/bilinear.h"
#include "sim/bending/laws/bridson.h"
#include "sim/bending/laws/chapman.h"
#include "sim/bending/laws/dahl.h"
#include "sim/bending/laws/flexion_spring.h"
#include "sim/bending/laws/gong.h"
#include "sim/bending/laws/grinspun_edit.h"
#include "sim/bending/laws/kim.h"
#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/linear.h"
#include "sim/bending/laws/narain.h"
#include "sim/bending/laws/obrien.h"
#include "sim/bending/laws/pabst.h"
#include "sim/bending/laws/prandtl.h"
#include "sim/bending/laws/terzopoulos.h"
#include "sim/bending/laws/wong.h"

namespace hysteron {

// The laws are in the order of `hysteron list laws`.
using EveryLaw =
    LawList<LinearLaw, BridsonLaw, FlexionSpringLaw, PabstLaw, BilinearLaw, WongLaw, PrandtlLaw,
            GrinspunEditLaw, TerzopoulosLaw, ObrienLaw, KimLaw, NarainLaw, DahlLaw, GongLaw, ChapmanLaw>;

// The groups of laws that take only the three numbers of their fabric.
struct MemorylessLaws : LawList<LinearLaw, BridsonLaw, FlexionSpringLaw, PabstLaw, GrinspunEditLaw> {};
struct FrictionLaws : LawList<BilinearLaw, WongLaw, PrandtlLaw, DahlLaw> {};
struct PlasticLaws : LawList<TerzopoulosLaw, ObrienLaw, KimLaw, NarainLaw, GongLaw> {};
// These laws follow faces that differ.
struct FacesLaws : LawList<LinearLaw, PrandtlLaw> {};
// The friction of these laws can weaken.
struct FatigueLaws : LawList<BilinearLaw, WongLaw, PrandtlLaw> {};
// These laws take the fabric's parts beyond b1, b2 and k0: with room for few or for many stops, without or
// with relaxing branches.
struct PartsLaws : LawList<PrandtlLaw, ChapmanLaw> {
  static constexpr int kStops = kFewStops;
  static constexpr bool kWithoutBranches = true, kWithBranches = true;
};
struct ManyLaws : LawList<PrandtlLaw, ChapmanLaw> {
  static constexpr int kStops = kMaxStops;
  static constexpr bool kWithoutBranches = true, kWithBranches = false;
};
struct ManyRelaxingLaws : LawList<ChapmanLaw> {
  static constexpr int kStops = kMaxStops;
  static constexpr bool kWithoutBranches = false, kWithBranches = true;
};

using LawGroups = LawList<MemorylessLaws, FrictionLaws, FatigueLaws, FacesLaws, PartsLaws, ManyLaws,
                          ManyRelaxingLaws, PlasticLaws>;

}  // namespace hysteron
