#include "sim/identification/decay_shape.h"

#include <algorithm>
#include <cmath>

#include "sim/identification/covariance.h"
#include "sim/identification/least_squares.h"

namespace hysteron {
namespace {

constexpr double kLowest = -1, kHighest = 8;  // exponents that are looked for
constexpr double kKnownTo = 0.5;              // standard error of an exponent that names a shape

DecayShape shape_of(double exponent) {
  if (exponent < 0.5) return DecayShape::linear;
  if (exponent < 1.5) return DecayShape::exponential;
  return exponent < 2.5 ? DecayShape::hyperbolic : DecayShape::steeper;
}

// Behind the last turn that a single mode does not make.
std::size_t first_of_one_mode(const std::vector<Amplitude>& all) {
  std::size_t first = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double ratio = all[i].value / all[i - 1].value;
    if (ratio < 1 - kFallsLess || ratio > 1 + kGrowsLess) first = i;
  }
  return first;
}

// Behind the last one that is too large.
std::size_t first_small(const std::vector<Amplitude>& all, double largest) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].value > largest) first = i + 1;
  return first;
}

// Amplitude over the first measured one, loss of all turns if each took what the first takes, exponent.
void fit(const std::vector<Amplitude>& all, Decay& decay) {
  const double scale = all[decay.first].value, turns = static_cast<double>(decay.used - 1);
  const auto residuals = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd off(decay.used);
    for (std::size_t i = 0; i < decay.used; ++i)
      off[i] =
          decayed(at[0], at[1] / turns, at[2], static_cast<double>(i)) - all[decay.first + i].value / scale;
    return off;
  };
  const double lost = -std::log1p(-decay.per_turn) * turns;
  const LeastSquares found = minimize(residuals, Eigen::Vector3d(1, lost, 1), Eigen::Vector3d(0, 0, kLowest),
                                      Eigen::Vector3d(2, turns, kHighest));
  decay.fitted_first = scale * found.parameters[0];
  decay.fitted_loss = found.parameters[1] / turns;
  decay.exponent = found.parameters[2];
  decay.exponent_stderr = std::sqrt(covariance(found.jacobian, found.residuals).matrix(2, 2));
}

}  // namespace

Eigen::Vector2d vertex_of_parabola(double before, double at, double after) {
  const double slope = (after - before) / 2, bend = after - 2 * at + before;
  const double where = bend != 0 ? -slope / bend : 0;
  return {where, at + slope * where / 2};
}

std::vector<TurningPoint> turning_points(const std::vector<double>& time, const std::vector<double>& x,
                                         double least, double share) {
  std::vector<TurningPoint> found;
  std::size_t extreme = 0;
  int direction = 0;
  const auto note = [&](std::size_t i) {
    const bool inside = i > 0 && i + 1 < x.size();
    const Eigen::Vector2d vertex =
        inside ? vertex_of_parabola(x[i - 1], x[i], x[i + 1]) : Eigen::Vector2d(0, x[i]);
    found.push_back({time[i] + (inside ? vertex.x() * (time[i + 1] - time[i]) : 0), vertex.y()});
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (direction >= 0 && x[i] > x[extreme]) extreme = i, direction = 1;
    if (direction <= 0 && x[i] < x[extreme]) extreme = i, direction = -1;
    const double swing = std::abs(x[extreme] - (found.empty() ? x.front() : found.back().value));
    if (std::abs(x[i] - x[extreme]) > std::max(least, share * swing)) {
      note(extreme);
      direction = x[i] > x[extreme] ? 1 : -1;
      extreme = i;
    }
  }
  return found;
}

std::vector<Amplitude> amplitudes_of(const std::vector<TurningPoint>& turns) {
  std::vector<Amplitude> result;
  for (std::size_t i = 1; i + 1 < turns.size(); ++i) {
    const double mean = (turns[i - 1].value + turns[i + 1].value) / 2;
    result.push_back({static_cast<int>(i), turns[i].time, std::abs(turns[i].value - mean) / 2});
  }
  return result;
}

std::string name_of(DecayShape shape) {
  switch (shape) {
    case DecayShape::linear:
      return "linear";
    case DecayShape::exponential:
      return "exponential";
    case DecayShape::hyperbolic:
      return "hyperbolic";
    case DecayShape::steeper:
      return "steeper than hyperbolic";
    case DecayShape::plateau:
      return "plateau";
    default:
      return "unknown";
  }
}

double decayed(double first, double loss, double exponent, double turns) {
  const double bent = (exponent - 1) * loss * turns;  // 0 for p = 1
  if (bent <= -1) return 0;
  // log1p(x)/(p - 1) without 0/0; its series has x^2/3 next.
  const double power =
      std::abs(bent) > 1e-6 ? std::log1p(bent) / (exponent - 1) : loss * turns * (1 - bent / 2);
  return first * std::exp(-power);
}

double Decay::fitted(double turns) const { return decayed(fitted_first, fitted_loss, *exponent, turns); }

Decay decay_of(const std::vector<Amplitude>& all, double largest) {
  Decay decay;
  const auto take_from = [&](std::size_t first) {
    decay.first = first;
    decay.used = all.size() - first;
    if (decay.used >= kLeastAmplitudes)
      decay.per_turn =
          1 - std::pow(all.back().value / all[first].value, 1 / static_cast<double>(decay.used - 1));
    return decay.used >= kLeastAmplitudes;
  };
  const std::size_t first = first_of_one_mode(all);
  if (!take_from(first)) return decay;
  if (decay.per_turn < kPlateau) {
    decay.shape = DecayShape::plateau;
    return decay;
  }
  if (!take_from(std::max(first, first_small(all, largest)))) return decay;
  if (all.back().value > (1 - kLeastFall) * all[decay.first].value) return decay;
  fit(all, decay);
  if (*decay.exponent_stderr <= kKnownTo)
    decay.shape = shape_of(*decay.exponent);
  else
    decay.exponent.reset(), decay.exponent_stderr.reset();
  return decay;
}

}  // namespace hysteron
