#include "sim/identification/decay_shape.h"

#include <algorithm>
#include <cmath>

#include "sim/identification/least_squares.h"
#include "sim/identification/saturating_decay.h"

namespace hysteron {
namespace {

// The following are shares of the largest amplitude.  A half period loses much more than its neighbours if it
// takes more than this and so many times as much as the one before and the one after.
constexpr double kFallsLess = 0.25, kOverBefore = 1.5, kOverAfter = 2, kGrowsLess = 0.05;
constexpr std::size_t kOnALine = 3;                 // amplitudes on each of two lines
constexpr int kPlaces = 400;                        // trial beginnings of the second line
constexpr double kLowRate = 1e-3, kHighRate = 1e3;  // over the inverse of the whole time
constexpr int kRates = 600;

struct Series {
  Eigen::VectorXd time, amplitude;  // [s] since the first, [m]

  Eigen::Index size() const { return time.size(); }
  double least_square() const { return std::pow(kBestAccuracy * amplitude.maxCoeff(), 2); }
};

DecayFit judged(DecayFit fit, int numbers, const Series& series) {
  double squares = 0;
  for (int i = 0; i < series.size(); ++i)
    squares += std::pow(series.amplitude[i] - fit.at(series.time[i]), 2);
  const auto n = static_cast<double>(series.size());
  fit.rms = std::sqrt(squares / n);
  fit.criterion = n * std::log(std::max(squares / n, series.least_square())) + numbers * std::log(n);
  return fit;
}

DecayFit line(const Series& series) {
  Eigen::MatrixXd by(series.size(), 2);
  by << Eigen::VectorXd::Ones(series.size()), -series.time;
  const Eigen::Vector2d found = linear_least_squares(by, series.amplitude);
  return judged({DecayShape::linear, found[0], found[1]}, 2, series);
}

// Finds the best of many beginnings of the second line, which is the flatter one.
DecayFit two_lines(const Series& series) {
  DecayFit best{DecayShape::two_step};
  best.rms = best.criterion = INFINITY;
  const double from = series.time[kOnALine - 1], to = series.time[series.size() - kOnALine];
  for (int place = 0; place <= kPlaces; ++place) {
    const double step = from + (to - from) * place / kPlaces;
    Eigen::MatrixXd by(series.size(), 3);
    by << Eigen::VectorXd::Ones(series.size()), -series.time.cwiseMin(step),
        -(series.time.array() - step).max(0).matrix();
    const Eigen::Vector3d found = linear_least_squares(by, series.amplitude);
    if (!(found[1] > found[2])) continue;
    const DecayFit fit = judged({DecayShape::two_step, found[0], found[1], step, found[2]}, 4, series);
    if (fit.rms < best.rms) best = fit;
  }
  return best;
}

// Fits a shape a g(b t): the best a at each of many b, then between the neighbours of the best b.
DecayFit curve(DecayShape shape, const Series& series) {
  const double whole = series.time[series.size() - 1];
  const auto with = [&](double rate) {
    DecayFit unit{shape, 1, rate};
    Eigen::VectorXd g(series.size());
    for (int i = 0; i < series.size(); ++i) g[i] = unit.at(series.time[i]);
    unit.first = g.dot(series.amplitude) / g.squaredNorm();
    return judged(unit, 2, series);
  };
  double low = std::log(kLowRate / whole), high = std::log(kHighRate / whole);
  DecayFit best = with(std::exp(low));
  while (high - low > 1e-9) {
    const double width = (high - low) / kRates, start = low;
    for (int i = 0; i <= kRates; ++i) {
      const DecayFit fit = with(std::exp(start + i * width));
      if (i > 0 && fit.rms >= best.rms) continue;
      best = fit;
      low = std::max(start, start + (i - 1) * width),
      high = std::min(start + kRates * width, start + (i + 1) * width);
    }
  }
  return best;
}

DecayFit saturating(const Series& series) {
  const auto list = [](const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  const SaturatingDecay found = fit_saturating_decay(list(series.time), list(series.amplitude));
  DecayFit fit{DecayShape::saturating, found.first, found.rate};
  fit.knee = found.knee;
  fit.stiffening = found.stiffening;
  return judged(fit, 4, series);
}

// Does `wider` become `narrow` at some of its numbers, so that it describes the same series as well?
bool is_limit(DecayShape narrow, DecayShape wider) {
  if (wider == DecayShape::two_step) return narrow == DecayShape::linear;
  return wider == DecayShape::saturating &&
         (narrow == DecayShape::linear || narrow == DecayShape::hyperbolic);
}

// Ranks by the criterion, but a shape that is not clearly better than its limit comes behind it.
void rank(std::vector<DecayFit>& fits) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const DecayFit& a, const DecayFit& b) { return a.criterion < b.criterion; });
  const DecayFit best = fits.front();
  const auto limit = std::find_if(fits.begin(), fits.end(),
                                  [&](const DecayFit& fit) { return is_limit(fit.shape, best.shape); });
  if (limit != fits.end() && limit->criterion - best.criterion < kClearMargin)
    std::rotate(fits.begin(), limit, limit + 1);
}

// Returns the first amplitude behind the last half period that a single mode cannot make.
std::size_t first_of_one_mode(const std::vector<Amplitude>& all) {
  std::size_t first = 0;
  double largest = 0;
  for (const Amplitude& a : all) largest = std::max(largest, a.value);
  const auto fall = [&](std::size_t i) { return all[i - 1].value - all[i].value; };
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool grows = -fall(i) > kGrowsLess * largest;
    const bool falls = fall(i) > kFallsLess * largest && (i == 1 || fall(i) > kOverBefore * fall(i - 1)) &&
                       (i + 1 < all.size() && fall(i) > kOverAfter * fall(i + 1));
    if (grows || falls) first = i;
  }
  return first;
}

// Returns the first amplitude behind the last one that is too large.
std::size_t first_small(const std::vector<Amplitude>& all, double largest) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].value > largest) first = i + 1;
  return first;
}

Series series_from(const std::vector<Amplitude>& all, std::size_t first) {
  const auto n = static_cast<Eigen::Index>(all.size() - first);
  Series series{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    series.time[i] = all[first + i].time - all[first].time;
    series.amplitude[i] = all[first + i].value;
  }
  return series;
}

}  // namespace

Eigen::Vector2d vertex_of_parabola(double before, double at, double after) {
  const double slope = (after - before) / 2, bend = after - 2 * at + before;
  const double where = bend != 0 ? -slope / bend : 0;
  return {where, at + slope * where / 2};
}

Eigen::Vector2d vertex_of_parabola(double before, double after, const Eigen::Vector3d& x) {
  constexpr double kEqual = 1e-9;  // relative difference of two intervals that rounding makes
  if (std::abs(after - before) < kEqual * after) {
    const Eigen::Vector2d vertex = vertex_of_parabola(x[0], x[1], x[2]);
    return {vertex.x() * after, vertex.y()};
  }
  const double rise = (x[1] - x[0]) / before, fall = (x[2] - x[1]) / after, whole = before + after;
  const double slope = (rise * after + fall * before) / whole, bend = 2 * (fall - rise) / whole;
  const double where = bend != 0 ? -slope / bend : 0;
  return {where, x[1] + slope * where / 2};
}

std::vector<TurningPoint> turning_points(const std::vector<double>& time, const std::vector<double>& x,
                                         double least, double fraction) {
  std::vector<TurningPoint> found;
  std::size_t extreme = 0;
  int direction = 0;
  const auto note = [&](std::size_t i) {
    const bool inside = i > 0 && i + 1 < x.size();
    const Eigen::Vector2d vertex =
        inside ? vertex_of_parabola(time[i] - time[i - 1], time[i + 1] - time[i], {x[i - 1], x[i], x[i + 1]})
               : Eigen::Vector2d(0, x[i]);
    found.push_back({time[i] + vertex.x(), vertex.y()});
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (direction >= 0 && x[i] > x[extreme]) extreme = i, direction = 1;
    if (direction <= 0 && x[i] < x[extreme]) extreme = i, direction = -1;
    const double swing = std::abs(x[extreme] - (found.empty() ? x.front() : found.back().value));
    if (std::abs(x[i] - x[extreme]) > std::max(least, fraction * swing)) {
      note(extreme);
      direction = x[i] > x[extreme] ? 1 : -1;
      extreme = i;
    }
  }
  return found;
}

std::vector<Amplitude> turning_amplitudes(const std::vector<TurningPoint>& turns) {
  std::vector<Amplitude> result;
  for (std::size_t i = 1; i + 1 < turns.size(); ++i) {
    const double mean = (turns[i - 1].value + turns[i + 1].value) / 2;
    result.push_back({static_cast<int>(i), turns[i].time, std::abs(turns[i].value - mean) / 2});
  }
  return result;
}

DecayFit line_through(const std::vector<Amplitude>& amplitudes) { return line(series_from(amplitudes, 0)); }

double DecayFit::at(double t) const {
  switch (shape) {
    case DecayShape::exponential:
      return first * std::exp(-rate * t);
    case DecayShape::hyperbolic:
      return first / (1 + rate * t);
    case DecayShape::saturating:
      return SaturatingDecay{first, rate, knee, stiffening}.at(t);
    case DecayShape::two_step:
      return first - rate * std::min(t, step) - last_rate * std::max(t - step, 0.0);
    default:
      return first - rate * t;
  }
}

const DecayFit& Decay::of(DecayShape shape) const {
  return *std::find_if(fits.begin(), fits.end(), [&](const DecayFit& fit) { return fit.shape == shape; });
}

Decay decay_between_amplitudes(const std::vector<Amplitude>& all, double largest) {
  Decay decay;
  const auto take_from = [&](std::size_t first) {
    decay.first = first;
    decay.used = all.size() - first;
    if (decay.used >= kMinAmplitudes)
      decay.per_turn =
          1 - std::pow(all.back().value / all[first].value, 1 / static_cast<double>(decay.used - 1));
    return decay.used >= kMinAmplitudes;
  };
  const std::size_t first = first_of_one_mode(all);
  if (!take_from(first)) return decay;
  if (decay.per_turn < kPlateau && all.back().value > (1 - kMinFall) * all[first].value) {
    decay.shape = DecayShape::plateau;
    return decay;
  }
  if (!take_from(std::max(first, first_small(all, largest)))) return decay;
  const Series series = series_from(all, decay.first);
  decay.fits = {line(series), two_lines(series), curve(DecayShape::exponential, series),
                curve(DecayShape::hyperbolic, series), saturating(series)};
  rank(decay.fits);
  const auto rival = std::find_if(decay.fits.begin() + 1, decay.fits.end(), [&](const DecayFit& fit) {
    return !is_limit(decay.best().shape, fit.shape);
  });
  decay.margin = rival->criterion - decay.best().criterion;
  if (decay.margin >= kMinMargin && all.back().value <= (1 - kMinFall) * all[decay.first].value)
    decay.shape = decay.best().shape;
  return decay;
}

double half_period_loss(const std::vector<Amplitude>& all, std::size_t first, double fraction) {
  if (first >= all.size()) return NAN;
  const double at = std::log(fraction * all[first].value);
  double before = 0, loss_before = 0;  // of the pair of amplitudes before
  for (std::size_t i = first + 1; i < all.size(); ++i) {
    const double here = std::log((all[i - 1].value + all[i].value) / 2);
    const double loss = 1 - all[i].value / all[i - 1].value;
    if (here <= at && i == first + 1) return here == at ? loss : NAN;
    if (here <= at) return loss_before + (loss - loss_before) * (before - at) / (before - here);
    before = here, loss_before = loss;
  }
  return NAN;
}

}  // namespace hysteron
