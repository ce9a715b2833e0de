// Time and memory of a step under several elements and laws.
#pragma once

#include <functional>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// A row for each element and law: the scene's steps, in batches of so many.  All of them take the substeps of
// the stiffest law, so that rows of one element differ by the law alone.
std::vector<Metrics> element_costs(const Scene& scene, int steps,
                                   const std::function<void(const Metrics&)>& measured);

}  // namespace hysteron::experiments
