// What a manifest says of a run, in words for captions.
#pragma once

#include <string>
#include <vector>

#include "experiments/run.h"

namespace hysteron::experiments {

// "strip of 90 by 30 mm, mesh unionjack, 1,000 triangles"
std::string cloth_words(const Json& manifest);
// "cotton-broad (b1 3.589e-05 N m, b2 1.157e-05 N m, k0 50 1/m, 123.8 g/m2, damping 1e-05 s)"
std::string fabric_words(const Json& manifest);
// "prandtl (memory=stops, stops=16)"
std::string law_words(const Json& manifest);
// "bdf2, step 4.167 ms, element shape, double precision"
std::string solver_words(const Json& manifest);
std::string device_words(const Json& manifest);
// "1000" is "1,000".
std::string grouped(long count);

// "Cloth: ...  Fabric: ...  Law: ...  Solver: ...  Device: ..." of runs with these names, each fact once if
// all have the same, else with the names that have it.
std::string facts_of(const std::vector<std::string>& names, const std::vector<const Json*>& manifests);

// "Written by `COMMAND`, hysteron 0.1.0 (commit 1f3a...)."
std::string origin_words(const std::string& command);

}  // namespace hysteron::experiments
