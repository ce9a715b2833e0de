#include "sim/identification/identification.h"

#include <fmt/core.h>

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

std::string rounded(double x) { return fmt::format("{:.4g}", x); }

std::string Assumptions::ratio_source() const {
  return "assumed: b2/b1 = " + number_text(ratio) +
         " (the four shipped fabrics with KES pairs have 0.32 to 0.58 at k0 = 50/m)";
}

std::string Assumptions::k0_source() const {
  return "assumed: k0 = " + number_text(k0) +
         "/m (50/m is the largest value that leaves the window of KES-FB2, 0.5 to 1.5 per cm, straight)";
}

}  // namespace hysteron
