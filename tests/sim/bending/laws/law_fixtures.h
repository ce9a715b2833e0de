// Fabrics, histories and small drivers shared by the tests of the bending laws.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "sim/bending/laws/law_commands.h"

namespace hysteron::testing {

// Cotton broad (Matsudaira et al. 2015: B = 1.157e-5 N m, 2HB = 1.216e-3 N), K0 = 50/m assumed.
inline constexpr VirginCurve kCotton{1.157e-5 + 1.216e-3 / 50, 1.157e-5, 50};

using Path = std::vector<Vec<double, 3>>;

// Corners of a random walk: uniformly drawn turns within +-`amplitude` [1/m], of widely different sizes.
inline std::vector<double> random_turns(int count, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> turns;
  for (int i = 0; i < count; ++i)
    turns.push_back(amplitude * uniform(generator) * std::abs(uniform(generator)));
  return turns;
}

inline Path random_tensors(int count, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Path path;
  for (int i = 0; i < count; ++i)
    path.push_back(amplitude * Vec<double, 3>(uniform(generator), uniform(generator), uniform(generator)));
  return path;
}

// A law with its memory, stepped along a path; sums what is dissipated.
template <class Law>
struct Driven {
  using Real = typename Law::Scalar;
  static constexpr int D = Law::kDimension;
  Law law;
  History<Real, Law::kHistory> history{};
  LawStep<Real, D, Law::kHistory> last{};
  double dissipated = 0;

  explicit Driven(const Law& l) : law(l) { last.moment.setZero(); }
  const LawStep<Real, D, Law::kHistory>& to(const Vec<Real, D>& curvature) {
    last = law.step(curvature, history);
    history = last.history;
    dissipated += last.dissipated;
    return last;
  }
  double moment(double curvature) requires(D == 1) { return to(Vec<Real, 1>(Real(curvature))).moment[0]; }
  // Returns the loss in a cycle of +-`amplitude`, after so many cycles that settle it.
  double cycle_loss(double amplitude, int settling = 1) requires(D == 1) {
    double before = 0;
    for (int i = 0; i <= settling; ++i) {
      before = dissipated;
      for (double side : {1., -1.}) moment(side * amplitude);
    }
    return dissipated - before;
  }
};

}  // namespace hysteron::testing
