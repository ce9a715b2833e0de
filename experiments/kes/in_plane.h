// `hysteron kes --test shear|tension` runs the KES-FB1 tests.
#pragma once

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

int run_in_plane(const CommandLine& line);
// Returns the keys of the in-plane tests that the bending test does not have.
std::vector<KeyDescription> in_plane_keys();

// A KES tester has these modes: KES-FB2 bends, KES-FB1 shears and stretches.
enum class TesterMode { bending, shear, tension };
constexpr std::array<const char*, 3> names(TesterMode) { return {"bending", "shear", "tension"}; }

// The test is of the law alone, or beside it of a specimen of cloth.
enum class Tested { law, strip };
constexpr std::array<const char*, 2> names(Tested) { return {"law", "strip"}; }

}  // namespace hysteron::experiments
