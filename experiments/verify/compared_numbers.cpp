#include "experiments/verify/compared_numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

bool has_part(const std::string& name, const char* part) { return name.find(part) != name.npos; }

std::string metric_change(const std::string& name, double before, double now) {
  constexpr double kSmall = 1e-4;  // below this difference the printed digits are the same
  const double part = std::abs(now - before) / std::max(std::abs(before), std::abs(now));
  return part < kSmall ? fmt::format("{} by {:.1e} of itself", name, part)
                       : fmt::format("{} {:.6g} -> {:.6g}", name, before, now);
}

}  // namespace

bool is_duration(const std::string& name) {
  return name.ends_with("setup_seconds") || name.ends_with("solve_s") || name.ends_with("computing_s") ||
         name.ends_with("ms_per_step") || name.ends_with("wall_s") || name == "overhead_percent" ||
         name.ends_with(".front_count");
}

bool is_effort(const std::string& name) {
  static const std::set<std::string> kNames = {"solver_iterations_per_step",
                                               "newton_iterations_per_step",
                                               "newton_residual_largest",
                                               "newton_velocity_largest_m_per_s",
                                               "newton_velocity_mean_m_per_s",
                                               "unbalanced_steps_count",
                                               "retried_steps_count",
                                               "deep_contact_steps_count",
                                               "pinched_steps_count",
                                               "slack_hand_steps_count",
                                               "barred_hand_steps_count",
                                               "energy_remainder_relative",
                                               "remainder",
                                               "fastest_m_per_s",
                                               "strip_newton_iterations_per_step",
                                               "strip_retried_steps_count",
                                               "iterations"};
  return kNames.contains(name.substr(name.rfind('.') + 1));
}

double stated_error(const Metrics& metrics, const std::string& name) {
  double sum = 0;
  for (const char* cause : {"_step_error", "_mesh_error", "_draw_error"}) {
    const MetricValue& error = metrics[name + cause];
    if (error.is_number()) sum += std::abs(error.number());
  }
  return sum;
}

double metric_scale(const std::string& name, double number) {
  double whole = 0;
  if (name.ends_with("_percent")) whole = 100;
  if (name.ends_with("_relative") || has_part(name, "_over_")) whole = 1;
  if (name.ends_with("_deg")) whole = 180;
  if (has_part(name, "curvature") && name.ends_with("_per_m")) whole = 1;
  return std::max(std::abs(number), whole);
}

void compare_numbers(const DifferingNumbers& numbers, ComparedNumbers& found) {
  const auto& [name, before, now, round_off, limit, error, counts] = numbers;
  const double difference = std::abs(now - before);
  std::string message = metric_change(name, before, now);
  if (limit)
    message += " (limit " + number_text(*limit) + ")";
  else if (error > 0)
    message += fmt::format(" (stated error {:g})", error);
  if (!limit && !counts && difference <= round_off)
    found.rounded.push_back(name);
  else
    (difference <= limit.value_or(error) ? found.within : found.beyond).push_back(message);
}

}  // namespace hysteron::experiments
