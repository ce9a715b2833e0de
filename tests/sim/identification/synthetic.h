// Measurements of known fabrics, with noise, for the tests of `hysteron fit`.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sim/bending/laws/law_run.h"
#include "sim/identification/series.h"

namespace hysteron {

inline constexpr VirginCurve kCotton{3.589e-5, 1.157e-5, 50};
inline constexpr double kRipple = 0.05;

// Curvatures from 0 through the given turning points, `per_leg` rows each, unevenly spaced.
inline std::vector<double> path(const std::vector<double>& turns, int per_leg) {
  std::vector<double> k;
  double from = 0;
  for (double to : turns) {
    for (int i = 1; i <= per_leg; ++i) {
      const double t = static_cast<double>(i) / per_leg;
      k.push_back(from + (to - from) * (t + 0.05 * std::sin(6.283185307179586 * t)));
    }
    from = to;
  }
  return k;
}

inline std::vector<double> law_moments(const std::string& law, const VirginCurve& curve,
                                       const std::vector<double>& curvature) {
  std::vector<LawRow> rows;
  for (double k : curvature) {
    LawRow row;
    row.curvature = k;
    rows.push_back(row);
  }
  return run_law({law, curve, {}}, rows).moment;
}

inline double largest(const std::vector<double>& values) {
  double top = 0;
  for (double value : values) top = std::max(top, std::abs(value));
  return top;
}

// Adds noise with a standard deviation of `noise` times the largest moment, the same on all rows.
inline void add_noise(std::vector<double>& moment, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise * largest(moment));
  for (double& m : moment) m += normal(random);
}

inline MomentSeries measured(const std::vector<double>& curvature, std::vector<double> moment, double noise,
                             unsigned seed) {
  MomentSeries series;
  series.name = "synthetic.csv";
  series.curvature = curvature;
  add_noise(moment, noise, seed);
  series.moment = std::move(moment);
  prepare(series, kRipple);
  return series;
}

inline MomentSeries measured(const std::string& law, const VirginCurve& curve,
                             const std::vector<double>& turns, double noise, unsigned seed,
                             int per_leg = 50) {
  const std::vector<double> k = path(turns, per_leg);
  return measured(k, law_moments(law, curve, k), noise, seed);
}

}  // namespace hysteron
