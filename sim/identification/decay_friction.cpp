#include "sim/identification/decay_friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/identification/swinging_strip.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

using Eigen::VectorXd;

constexpr int kParts = 8;              // parts of a half period
constexpr double kFarthestNumber = 9;  // largest distance of a logarithm from its prior
constexpr std::size_t kFewest = 6;
constexpr int kTabulated = 16;  // number of amplitudes at which the strip's fall is computed
// Elasticity beside trial friction is at least this share of B: stops that a tester reads as steeper than B
// are refused once they are found.
constexpr double kLeastSpring = 0.05;

class DecayModel {
 public:
  DecayModel(const DecaySeries& series, const DecayQuestion& question)
      : series_(series),
        question_(question),
        form_(question.form ? *question.form : parabola_friction()),
        strip_(question.length, question.density),
        elastic_(strip_.at({series.amplitude[0]}, question.rigidity, {}).front()) {
    double fall = 0;
    for (std::size_t i = 1; i < series.amplitude.size(); ++i) {
      const double omega = omega_of_turn(i - 1), k = question.density * omega * omega * elastic_.square;
      fall = std::max(fall, k * std::max(series.amplitude[i - 1] - series.amplitude[i], question.noise));
    }
    prior_friction_ = fall / (2 * elastic_.bend);
  }

  int numbers() const { return static_cast<int>(form_.spreads.size()); }
  int rows() const { return static_cast<int>(series_.amplitude.size()); }
  const FrictionForm& form() const { return form_; }
  Spectrum stops(const VectorXd& p) const { return form_.stops(p.head(numbers()), prior_friction_); }

  std::vector<double> amplitudes(const Spectrum& stops, double first) const {
    const FallTable& table = falls(stops, first);
    std::vector<double> all = {first};
    for (int i = 0; i + 1 < rows(); ++i) {
      double a = all.back();
      const double h = 1.0 / kParts, omega = omega_of_turn(i);
      for (int part = 0; part < kParts; ++part) {
        const double middle = a - h / 2 * table.at(a) / (omega * omega);
        a = std::max(0.0, a - h * table.at(middle) / (omega * omega));
      }
      all.push_back(a);
    }
    return all;
  }

  // Returns the deepest minimum of those from the prior and from each start of the form; of minima as deep,
  // the first.
  LeastSquares deepest_minimum(const VectorXd& low, const VectorXd& high) const {
    const auto from = [&](const VectorXd& start, SearchLimits limits = {100, 1e-8}) {
      return minimize([&](const VectorXd& p) { return residuals(p); }, start, low, high, limits);
    };
    LeastSquares best = from(VectorXd::Zero(numbers() + 1));
    for (const VectorXd& friction : form_.starts) {
      VectorXd start = VectorXd::Zero(numbers() + 1);
      start.head(numbers()) = friction;
      const LeastSquares other = from(start, {20, 1e-3});
      if (is_deeper(other, best)) best = from(other.parameters);
    }
    return best;
  }

  // Returns the strip's largest curvature at its first amplitude [1/m].
  double reach() const { return elastic_.curvature; }

  VectorXd residuals(const VectorXd& p) const {
    const std::vector<double> all = amplitudes(stops(p), series_.amplitude[0] * std::exp(p[numbers()]));
    VectorXd result(rows() + numbers());
    for (int i = 0; i < rows(); ++i) result[i] = (all[i] - series_.amplitude[i]) / question_.noise;
    for (int j = 0; j < numbers(); ++j) result[rows() + j] = p[j] / form_.spreads[j];
    return result;
  }

 private:
  // A table by amplitude: omega^2 times the loss of amplitude in half a period [m/s^2].
  struct FallTable {
    std::vector<double> logarithm, fall;

    // Interpolates between amplitudes as a power, which a line (0) and a hyperbola (2) are; below them as a
    // hyperbola.
    double at(double amplitude) const {
      if (std::isnan(amplitude)) return amplitude;  // of stops that a search tries and refuses
      const double x = std::log(std::max(amplitude, 1e-300));
      if (x <= logarithm.front()) return fall.front() * std::exp(2 * (x - logarithm.front()));
      if (x >= logarithm.back()) return fall.back();
      const auto i = std::upper_bound(logarithm.begin(), logarithm.end(), x) - logarithm.begin();
      const double part = (x - logarithm[i - 1]) / (logarithm[i] - logarithm[i - 1]);
      if (!(fall[i - 1] > 0)) return part * fall[i];
      return fall[i - 1] * std::pow(fall[i] / fall[i - 1], part);
    }
  };

  // Returns the table from above the largest amplitude down to a fraction of it; the last table is kept,
  // since a search asks for several first amplitudes of the same stops.
  const FallTable& falls(const Spectrum& stops, double first) const {
    if (table_.logarithm.empty() || std::log(first) > table_.logarithm.back() ||
        stops.thresholds != tabulated_.thresholds || stops.stiffnesses != tabulated_.stiffnesses) {
      table_ = computed_falls(stops, first);
      tabulated_ = stops;
    }
    return table_;
  }
  FallTable computed_falls(const Spectrum& stops, double first) const {
    constexpr double kAbove = 1.2, kSpan = 80;
    const double spring =
        std::max(kLeastSpring * question_.rigidity, question_.rigidity - kes_pair(0, stops).rigidity);
    const double most = *std::max_element(series_.amplitude.begin(), series_.amplitude.end()),
                 high = std::log(kAbove * std::max(most, first)), low = high - std::log(kSpan);
    std::vector<double> amplitudes;
    for (int i = 0; i < kTabulated; ++i)
      amplitudes.push_back(std::exp(low + (high - low) * i / (kTabulated - 1)));
    const std::vector<SwingState> states = strip_.at(amplitudes, spring, stops);
    FallTable table;
    for (int i = 0; i < kTabulated; ++i) {
      const SwingState &before = states[std::max(i - 1, 0)], &after = states[std::min(i + 1, kTabulated - 1)],
                       &here = states[i];
      // The loop computes A dE/dA from the power of A with which E rises.
      const double power =
          std::log(after.stored / before.stored) / std::log(after.amplitude / before.amplitude);
      table.logarithm.push_back(std::log(here.amplitude));
      table.fall.push_back(here.amplitude * here.lost / 2 / (power * here.stored) * here.omega * here.omega);
    }
    return table;
  }
  // Returns the measured omega between amplitude i and the next [rad/s].
  double omega_of_turn(std::size_t i) const {
    return std::numbers::pi / (series_.time[i + 1] - series_.time[i]);
  }

  const DecaySeries& series_;
  const DecayQuestion& question_;
  FrictionForm form_;
  SwingingStrip strip_;
  SwingState elastic_;         // at the first amplitude, as if there were no friction
  double prior_friction_ = 0;  // [N]
  mutable FallTable table_;    // for the stops tabulated_
  mutable Spectrum tabulated_;
};

}  // namespace

DecaySeries read_decay(const std::filesystem::path& file, const std::string& reader) {
  const Table table = read_csv(file, {"time [s]", "amplitude [m]"}, {}, reader);
  DecaySeries series{table.numbers("time [s]"), table.numbers("amplitude [m]")};
  if (series.time.size() < kFewest)
    throw Error::invalid_input(reader + ": " + file.string() + " has " + std::to_string(series.time.size()) +
                               " amplitudes and must have at least " + std::to_string(kFewest));
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    if (i > 0 && !(series.time[i] > series.time[i - 1]))
      throw table.refusal(i, "time must rise from turn to turn");
    if (!(series.amplitude[i] > 0)) throw table.refusal(i, "amplitude must be > 0");
  }
  return series;
}

namespace {

constexpr double kShortestStrip = 5e-3, kLongestStrip = 2;  // below a clamp in a laboratory [m]
constexpr double kMillimetre = 1e-3;                        // [m]

// Suggests the amplitude in millimetres, or as half of the way from peak to peak.
std::string amplitude_hint(double amplitude, double length) {
  if (amplitude * kMillimetre >= kMillimetre && amplitude * kMillimetre < length)
    return "; millimetres given as metres? Then it is " + number_text(amplitude * kMillimetre, 4) + " m";
  if (amplitude / 2 < length)
    return "; from peak to peak? An amplitude is half of that, " + number_text(amplitude / 2, 4) + " m";
  return "";
}

}  // namespace

void check_decay(const DecaySeries& series, const DecayQuestion& question, const std::string& file) {
  const double length = question.length, first = series.amplitude.front(), last = series.amplitude.back();
  if (!(length >= kShortestStrip && length <= kLongestStrip))
    throw Error::invalid_input("decay.length = " + number_text(length) + " m must be in [" +
                               number_text(kShortestStrip) + ", " + number_text(kLongestStrip) +
                               "] m, as strips below a clamp are")
        .with_key("decay.length", number_text(length));
  for (const double amplitude : series.amplitude)
    if (!(amplitude < length))
      throw Error::invalid_input(file + ": amplitude = " + number_text(amplitude) +
                                 " m must be < decay.length = " + number_text(length) +
                                 " m, the strip's: its free end cannot swing farther" +
                                 amplitude_hint(amplitude, length))
          .with_key("decay", file);
  if (!(last < first + question.noise))
    throw Error::invalid_input(file + ": amplitudes rise from " + number_text(first, 4) + " m to " +
                               number_text(last, 4) +
                               " m, and must fall, since friction takes energy: do the rows run backwards "
                               "in time?")
        .with_key("decay", file);
}

namespace {

// Returns the number of amplitudes above half of the strip's length, from the first on.
std::size_t large_amplitudes(const DecaySeries& series, double length) {
  const auto small = std::ranges::find_if(series.amplitude, [&](double a) { return a <= length / 2; });
  return static_cast<std::size_t>(small - series.amplitude.begin());
}

}  // namespace

DecaySeries without_large_amplitudes(const DecaySeries& series, double length) {
  const auto large = static_cast<std::ptrdiff_t>(large_amplitudes(series, length));
  if (series.time.size() - static_cast<std::size_t>(large) < kFewest) return series;
  return {{series.time.begin() + large, series.time.end()},
          {series.amplitude.begin() + large, series.amplitude.end()}};
}

std::string large_amplitudes_warning(const DecaySeries& series, double length) {
  const std::size_t large = large_amplitudes(series, length), all = series.time.size();
  if (large == 0) return "";
  const std::string which = std::to_string(large) + " of " + std::to_string(all) +
                            " amplitudes are above half of the strip's length, " +
                            number_text(length / 2, 4) +
                            " m, where it does not swing in the mode of small ones";
  return all - large < kFewest ? which + ": HB and k0 may come out a fifth low; write down smaller ones, too"
                               : which + ": they are left out";
}

std::vector<std::string> decay_warnings(const DecaySeries& series, const DecayQuestion& question) {
  // The first modes are those of a cantilever without weight, and of a hanging chain (half of the first zero
  // of J0).
  constexpr double kCantilever = 3.516, kChain = 1.2024, kGravity = 9.81;
  // Large amplitudes slow a strip down; friction that has not slipped makes it stiffer, b1/b2 = 1 + 2
  // (HB/B)/k0: HB/B of clothing is up to some 50/m, and knees begin at 4/m.
  constexpr double kSlowest = 0.6, kLongest = 1.6;
  const double stiffest = std::sqrt(1 + 2 * 50. / 4);
  std::vector<double> turns;
  for (std::size_t i = 1; i < series.time.size(); ++i) turns.push_back(series.time[i] - series.time[i - 1]);
  std::vector<double> sorted = turns;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double usual = sorted[sorted.size() / 2], length = question.length;
  const double elastic = kCantilever / (length * length) * std::sqrt(question.rigidity / question.density),
               weight = kChain * std::sqrt(kGravity / length);
  const double longest = std::numbers::pi / (kSlowest * std::hypot(elastic, weight)),
               shortest = std::numbers::pi / std::hypot(stiffest * elastic, weight);
  std::vector<std::string> warnings;
  if (usual > longest || usual < shortest)
    warnings.push_back(
        "a turn takes " + number_text(usual, 4) +
        " s, and half a period of a hanging strip of this length, " + "weight and rigidity takes " +
        number_text(shortest, 4) + " to " + number_text(longest, 4) +
        " s: HB goes with the inverse square of the time; are the times in seconds, and is there an "
        "amplitude of every turn, on both sides?");
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (turns[i] > kLongest * usual) {
      warnings.push_back("the turn from t = " + number_text(series.time[i]) + " s takes " +
                         number_text(turns[i], 4) + " s, and the others some " + number_text(usual, 4) +
                         " s: is an amplitude missing?");
      break;
    }
  return warnings;
}

std::vector<double> decay_by(const DecaySeries& series, const DecayQuestion& question, const Spectrum& stops,
                             double first) {
  return DecayModel(series, question).amplitudes(stops, first);
}

FabBending identify_decay(const DecaySeries& series, const DecayQuestion& question) {
  const DecayModel model(series, question);
  const int n = model.numbers();
  VectorXd low = VectorXd::Constant(n + 1, -kFarthestNumber), high = -low;
  low[n] = -0.5, high[n] = 0.5;
  if (model.form().largest) high.head(n) = model.form().largest(model.reach());
  const LeastSquares best = model.deepest_minimum(low, high);
  const Eigen::MatrixXd c = posterior(best, model.rows());
  const VectorXd left = best.residuals.head(model.rows());
  const VectorXd of_stops = stop_errors(model.form(), best.parameters.head(n), c.topLeftCorner(n, n));

  FabBending found;
  found.direction = "the strip";
  const Spectrum stops = model.stops(best.parameters);
  found.law = {question.rigidity - kes_pair(0, stops).rigidity, stops.thresholds, stops.stiffnesses};
  found.form = best.parameters.head(n);
  found.first = series.amplitude[0] * std::exp(best.parameters[n]);
  found.form_errors = c.diagonal().head(n).cwiseMax(0).cwiseSqrt();
  found.set_errors(0, of_stops);
  found.spring_error = 0;  // whatever the sign of the remaining rigidity
  found.friction_error = of_stops[found.law.stops()] * found.law.friction();
  found.rows = model.rows();
  found.residual_rms = std::sqrt(left.squaredNorm() / model.rows());
  found.residual_share = found.residual_rms * question.noise / series.amplitude[0];
  found.reach = model.reach();
  found.residuals = left;
  found.noise = question.noise;
  found.form_name = model.form().name;
  found.iterations = best.iterations;
  found.converged = best.converged;
  return found;
}

std::string pace_warning(const DecaySeries& series, const DecayQuestion& question, const FabBending& found) {
  // Intervals may lie between amplitudes of every half period (a ratio of 1) and of every second one (2).
  const double different = std::sqrt(2);
  constexpr std::size_t kLast = 3;  // number of half periods whose mean time is compared
  const std::size_t n = series.time.size();
  const double measured = (series.time[n - 1] - series.time[n - 1 - kLast]) / kLast;
  const double amplitude = std::sqrt(series.amplitude[n - 1] * series.amplitude[n - 1 - kLast]);
  const SwingState state =
      SwingingStrip(question.length, question.density)
          .at({amplitude}, found.law.spring, {found.law.thresholds, found.law.stiffnesses})
          .front();
  const double fitted = std::numbers::pi / state.omega;
  if (measured < different * fitted && fitted < different * measured) return "";
  return "at its smallest amplitudes the fitted strip takes " + number_text(fitted, 4) +
         " s for a turn, and the data " + number_text(measured, 4) +
         " s: the fit contradicts itself, and HB goes with the inverse square of the time; is there an "
         "amplitude of every turn, on both sides, and are kes.b and fabric.density the strip's?";
}

std::vector<FabForm> even_forms(const DecaySeries& series, const DecayQuestion& question) {
  const auto identify = [&](const FrictionForm& form) {
    DecayQuestion one = question;
    one.form = form;
    // Friction that saturates far beyond reach has a moment far above its loss there.
    for (const double logarithm : {2., 5.}) one.form->starts.emplace_back(VectorXd::Constant(1, logarithm));
    FabBending found = identify_decay(series, one);
    if (!(found.law.spring > 0))
      throw Error::simulation("friction of " + form.name + " alone is steeper than the rigidity");
    return found;
  };
  return even_form_fits(identify, kFewStops);
}

}  // namespace hysteron
