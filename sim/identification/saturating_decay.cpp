#include "sim/identification/saturating_decay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/identification/least_squares.h"

namespace hysteron {
namespace {

using Eigen::VectorXd;

constexpr double kTwoThirds = 2.0 / 3;
constexpr int kMostNewton = 60;       // most iterations, which converge from one side
constexpr double kConverged = 1e-13;  // relative change of the unknown

// These are G of the header and its inverse, x >= 1.
double time_above(double x) { return x + kTwoThirds * std::log(x - kTwoThirds); }
double amplitude_above(double g, double largest) {
  double z = std::log(largest - kTwoThirds);  // z = ln(x - 2/3): e^z + 2/3 z + 2/3 = G is convex
  for (int i = 0; i < kMostNewton; ++i) {
    const double change = (std::exp(z) + kTwoThirds * z + kTwoThirds - g) / (std::exp(z) + kTwoThirds);
    z -= change;
    if (std::abs(change) < kConverged * std::max(1.0, std::abs(z))) break;
  }
  return std::exp(z) + kTwoThirds;
}

// These are H of the header and its inverse, x <= 1.
double time_below(double x, double s) { return s / x + (s - 1) * std::log(x); }
double amplitude_below(double h, double s) {
  double w = std::max(1.0, h);  // w = 1/x: s w - (s - 1) ln w = H is convex, and w <= H
  for (int i = 0; i < kMostNewton; ++i) {
    const double change = (s * w - (s - 1) * std::log(w) - h) / (s - (s - 1) / w);
    w = std::max(1.0, w - change);
    if (std::abs(change) < kConverged * w) break;
  }
  return 1 / w;
}

// The parameters of the search are the logarithms of first amplitude, rate and knee, over the scales, and of
// the stiffening.
struct Search {
  const std::vector<double>& time;
  const std::vector<double>& amplitude;

  double scale() const { return amplitude.front(); }
  SaturatingDecay decay(const VectorXd& p) const {
    return {scale() * std::exp(p[0]), scale() / time.back() * std::exp(p[1]), scale() * std::exp(p[2]),
            std::exp(p[3])};
  }
  VectorXd residuals(const VectorXd& p) const {
    const SaturatingDecay found = decay(p);
    VectorXd left(static_cast<Eigen::Index>(time.size()));
    for (std::size_t i = 0; i < time.size(); ++i)
      left[static_cast<Eigen::Index>(i)] = (found.at(time[i]) - amplitude[i]) / scale();
    return left;
  }
  // Returns a start with the rate that leads to the last amplitude.
  VectorXd start(double knee_fraction, double stiffening) const {
    const SaturatingDecay unit{scale(), scale() / time.back(), knee_fraction * scale(), stiffening};
    const double last = std::clamp(amplitude.back(), 1e-3 * scale(), 0.999 * scale());
    return Eigen::Vector4d(0, std::log(unit.time_to(last) / time.back()), std::log(knee_fraction),
                           std::log(stiffening));
  }
};

}  // namespace

double SaturatingDecay::at(double time) const {
  double left = time * rate / knee, x = first / knee;
  if (x > 1) {
    const double g = time_above(x) - left;
    if (g >= time_above(1)) return knee * amplitude_above(g, x);
    left = time_above(1) - g;
    x = 1;
  }
  return knee * amplitude_below(time_below(x, stiffening) + left / 3, stiffening);
}

double SaturatingDecay::time_to(double amplitude) const {
  const double from = first / knee, to = amplitude / knee;
  double tau = 0;
  if (from > 1) tau += time_above(from) - time_above(std::max(to, 1.0));
  if (to < 1) tau += 3 * (time_below(to, stiffening) - time_below(std::min(from, 1.0), stiffening));
  return tau * knee / rate;
}

SaturatingDecay fit_saturating_decay(const std::vector<double>& time, const std::vector<double>& amplitude) {
  constexpr double kKnees[] = {0.03, 0.1, 0.2, 0.35, 0.6, 1};  // over the first amplitude
  constexpr double kStiffenings[] = {1.1, 3, 8};
  constexpr std::size_t kFollowed = 2;  // number of best starts that are followed
  constexpr SearchLimits kCoarse = {10, 1e-3}, kFine = {40, 1e-7};
  const Search search{time, amplitude};
  std::vector<std::pair<double, VectorXd>> starts;
  for (const double knee : kKnees)
    for (const double stiffening : kStiffenings) {
      const VectorXd p = search.start(knee, stiffening);
      starts.emplace_back(search.residuals(p).squaredNorm(), p);
    }
  std::sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  // The bounds of the logarithms allow a knee from 1 % to the sevenfold first amplitude, and a stiffening up
  // to 50.
  const Eigen::Vector4d low(-0.7, -12, -4.6, 0), high(0.7, 12, 2, 3.9);
  const auto from = [&](const VectorXd& start, SearchLimits limits) {
    return minimize([&](const VectorXd& p) { return search.residuals(p); }, start, low, high, limits);
  };
  LeastSquares best = from(starts[0].second, kCoarse);
  for (std::size_t i = 1; i < kFollowed; ++i) {
    LeastSquares found = from(starts[i].second, kCoarse);
    if (found.sum() < best.sum()) best = std::move(found);
  }
  best = from(best.parameters, kFine);
  return search.decay(best.parameters);
}

}  // namespace hysteron
