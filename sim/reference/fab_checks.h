// What the loops of a FAB tester must be like before anything is read off them or fitted to them.
#pragma once

#include <string>

#include "sim/reference/fab_loops.h"

namespace hysteron {

// Largest slack of a strip that bends, and largest stretch of one that is pulled, at the beginning of a test,
// over its gauge: testers begin with a strip that is almost straight.
inline constexpr double kLargestStart = 0.25;

// The way of the clamps: a test and a direction that there are, two branches a cycle, lengths of a strip, a
// beginning near the gauge, rows in order, branches that go out and back, each from where the last ended.
// Throws Error::request: "fit: loops.csv: L D1: ...".
void check_fab_way(const FabLoops& loops, const std::string& file, const std::string& reader);

// Forces on that way: they vary, rise as the clamps part (tension > 0), and over a cycle the strip takes
// work. The zero of force does not matter.  Throws as check_fab_way().
void check_fab_forces(const FabLoops& loops, const std::string& file, const std::string& reader);

}  // namespace hysteron
