#include "experiments/sweep/latin_hypercube.h"

#include <numeric>
#include <random>
#include <utility>

namespace hysteron::experiments {
namespace {

// The standard fixes the engine's numbers, not those of its distributions.
double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

}  // namespace

std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::vector<double>> drawn(axes, std::vector<double>(n));
  std::vector<std::size_t> part(n);
  for (std::vector<double>& axis : drawn) {
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) {  // Durstenfeld 1964
      const auto other = static_cast<std::size_t>(uniform(engine) * static_cast<double>(i));
      std::swap(part[i - 1], part[other]);
    }
    for (std::size_t i = 0; i < n; ++i)
      axis[i] = (static_cast<double>(part[i]) + uniform(engine)) / static_cast<double>(n);
  }
  return drawn;
}

}  // namespace hysteron::experiments
