#include "sim/identification/identification.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/key_table.h"

namespace hysteron {

std::vector<std::string> Identification::undetermined() const {
  std::vector<std::string> names;
  if (!b1.determined) names.push_back("b1");
  if (!b2.determined) names.push_back("b2");
  if (!k0.determined) names.push_back("k0");
  return names;
}

double Identification::residual_rms() const {
  double sum = 0;
  for (std::size_t i = 0; i < moment.size(); ++i) sum += (moment[i] - model[i]) * (moment[i] - model[i]);
  return std::sqrt(sum / static_cast<double>(moment.size()));
}

double Identification::largest_moment() const {
  double largest = 0;
  for (double value : moment) largest = std::max(largest, std::abs(value));
  return largest;
}

std::string Assumptions::ratio_source() const {
  return "assumed: b2/b1 = " + number_text(ratio) +
         " (no source gives it: the four shipped fabrics with KES pairs have 0.07 to 0.18 at k0 = 8/m, "
         "0.32 to 0.58 at 50/m)";
}

std::string Assumptions::k0_source() const {
  return "assumed: k0 = " + number_text(k0) +
         "/m (8/m agrees with the loops of one knit and with how vibrations of cloth are reported to fall; 4 "
         "to 25/m are possible)";
}

Estimate Assumptions::assumed_k0() const {
  constexpr double kLow = 4, kHigh = 25;  // [1/m]
  return {k0, kNone, false, k0_source(), "assumed", std::min(k0, kLow), std::max(k0, kHigh)};
}

}  // namespace hysteron
