// Few points that cover many axes evenly.
#pragma once

#include <cstdint>
#include <vector>

namespace hysteron::experiments {

// `n` numbers in [0, 1) of each of `axes`, by axis: every n-th part of an axis is drawn from once, in an
// order of its own (McKay, Beckman & Conover 1979, Technometrics 21:239).  The same seed gives the same
// numbers on every machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint64_t seed);

}  // namespace hysteron::experiments
