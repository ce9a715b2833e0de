#include "sim/identification/loop_warnings.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number_in.h"
#include "sim/bending/laws/unused_parameters.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

constexpr double kMisses = 0.25;  // over the largest moment: data farther from a law (rms) are another law's
const VirginCurve kAnyCurve = {2e-5, 1e-5, 50, {}};  // stands for the sought curve

// Warns if the zero of curvature is off: a tester that bends to opposite curvatures finds opposite moments,
// so that opposite moments at curvatures that are not opposite tell it.
std::string curvature_zero_warning(const MomentSeries& series) {
  constexpr double kNoticed = 0.02;  // over the half range of curvature
  const auto [low, high] = std::ranges::minmax(series.curvature);
  const auto [least, most] = std::ranges::minmax(series.moment);
  const double middle = (low + high) / 2, half = (high - low) / 2;
  const double beside = std::abs(middle) / half, of_moment = std::abs(least + most) / (most - least);
  if (!(beside > kNoticed && of_moment < beside / 2 && low < 0 && high > 0)) return "";
  return "curvatures go from " + number_text(low, 4) + " to " + number_text(high, 4) +
         " 1/m, while the moments at their ends are opposite: the zero of curvature seems to be off by " +
         number_text(middle, 3) + " 1/m, which b1 and k0 do not stand; --curvature-offset finds it";
}

// Warns of laws that take time, where the data have none.
std::string time_warning(const MomentSeries& series, const std::vector<LawRequest>& laws) {
  const bool measured = !series.seconds.empty();
  const auto passes = [](double seconds) { return seconds > 0; };
  if (std::ranges::any_of(series.seconds, passes)) return "";
  std::vector<std::string> timed;
  for (const LawRequest& law : laws)
    if (takes_time({law.name, kAnyCurve, law.parameters})) timed.push_back(law.name);
  if (timed.empty()) return "";
  return series.name + (measured ? " has a column time [s] that does not rise" : " has no column time [s]") +
         ", and " + join(timed, ", ") + (timed.size() == 1 ? " takes" : " take") +
         " time: every row is taken as a step of " + (measured ? "0 s" : "1 s");
}

}  // namespace

std::vector<std::string> loop_warnings(const MomentSeries& series, const std::vector<LawRequest>& laws,
                                       bool seeks_curvature_offset) {
  std::vector<std::string> warnings = {time_warning(series, laws)};
  for (const LawRequest& law : laws)
    for (const std::string& warning :
         unused_parameter_warnings(law.name, kAnyCurve, law.parameters, LawUse::alone, "the fabric"))
      warnings.push_back(warning);
  if (!seeks_curvature_offset) warnings.push_back(curvature_zero_warning(series));
  std::erase(warnings, "");
  return warnings;
}

std::string misses_warning(const Identification& found) {
  const double share = found.residual_rms() / found.largest_moment();
  if (share <= kImplausibleMiss) return "";
  const std::string miss = " them by " + number_text(100 * share, 4) + " % of the largest moment (rms)";
  if (!(share <= kMisses)) return found.law + " does not describe these data: it misses" + miss;
  return found.law + " is not near these data: it misses" + miss +
         "; another law may be nearer (--law all), and plot_residual shows where";
}

}  // namespace hysteron
