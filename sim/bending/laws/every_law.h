// Every law, and the groups that their loops are compiled with: a law stands in one group of its own, and in
// those besides whose parts it takes (law_groups.h).
#pragma once

#include "sim/bending/laws/bilinear.h"
#include "sim/bending/laws/bridson.h"
#include "sim/bending/laws/chapman.h"
#include "sim/bending/laws/dahl.h"
#include "sim/bending/laws/flexion_spring.h"
#include "sim/bending/laws/gong.h"
#include "sim/bending/laws/grinspun_edit.h"
#include "sim/bending/laws/kim.h"
#include "sim/bending/laws/law_groups.h"
#include "sim/bending/laws/linear.h"
#include "sim/bending/laws/narain.h"
#include "sim/bending/laws/obrien.h"
#include "sim/bending/laws/pabst.h"
#include "sim/bending/laws/prandtl.h"
#include "sim/bending/laws/terzopoulos.h"
#include "sim/bending/laws/wong.h"

namespace hysteron {

// In the order of `hysteron list laws`.
using EveryLaw =
    LawList<LinearLaw, BridsonLaw, FlexionSpringLaw, PabstLaw, BilinearLaw, WongLaw, PrandtlLaw,
            GrinspunEditLaw, TerzopoulosLaw, ObrienLaw, KimLaw, NarainLaw, DahlLaw, GongLaw, ChapmanLaw>;

struct MemorylessLaws : LawList<LinearLaw, BridsonLaw, FlexionSpringLaw, PabstLaw, GrinspunEditLaw> {};
struct FrictionLaws : LawList<BilinearLaw, WongLaw, PrandtlLaw, DahlLaw> {};
struct FatigueLaws : LawList<BilinearLaw, WongLaw, PrandtlLaw> {};
struct PartsLaws : LawList<PrandtlLaw, ChapmanLaw> {};
struct ManyLaws : LawList<PrandtlLaw, ChapmanLaw> {};
struct PlasticLaws : LawList<TerzopoulosLaw, ObrienLaw, KimLaw, NarainLaw, GongLaw> {};

}  // namespace hysteron
