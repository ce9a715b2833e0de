// The groups of laws whose loops are compiled together (every_law.h says which laws they hold).
#pragma once

#include "sim/bending/laws/law_description.h"

namespace hysteron {

struct MemorylessLaws;
struct FrictionLaws;
struct FatigueLaws;  // whose friction can weaken
struct PartsLaws;    // that take what a fabric has beyond b1, b2 and k0, with few stops
struct ManyLaws;     // the same with many
struct PlasticLaws;
using LawGroups = LawList<MemorylessLaws, FrictionLaws, FatigueLaws, PartsLaws, ManyLaws, PlasticLaws>;

}  // namespace hysteron
