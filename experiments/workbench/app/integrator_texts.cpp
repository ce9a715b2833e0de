#include "experiments/workbench/app/integrator_texts.h"

#include <fmt/core.h>

#include <cmath>

namespace hysteron::experiments {

namespace {

// The share of all dissipated energy that the integrator may have, and that over what else was dissipated.
constexpr double kMostShare = 0.25, kMostPart = kMostShare / (1 - kMostShare);

}  // namespace

std::string integrator_text(const Ledger& ledger, double step) {
  constexpr double kMin = 0.01;
  const double fraction = ledger.integrator_share();
  if (!(fraction > kMostShare) || fraction == 1) return "";
  const double part = fraction / (1 - fraction);
  if (ledger.integrator() < 0)
    return fmt::format("{} gave {:.2g} J, {:.0f} % of what else was dissipated: take shorter steps",
                       kIntegrator, -ledger.integrator(), 100 * part);
  const double factor = kMostPart / part;
  const std::string text =
      fmt::format("{} took {:.0f} % of all energy that was dissipated", kIntegrator, 100 * fraction);
  if (factor < kMin) return text + ": nearly all, so that no step can be named that would do";
  return text +
         fmt::format(": if its part shrinks with the step, steps of about {:.2g} s would take {:.0f} %",
                     factor * step, 100 * kMostShare);
}

std::string integrator_text(double part, double at_half, double step) {
  const auto percent = [](double p) { return 100 - 100 / (1 + std::abs(p)); };  // 100 of an infinite part
  const double at_none = 2 * at_half - part;
  const std::string text =
      fmt::format("{}'s share of all dissipation is {:.0f} %, {:.0f} % with half the step", kIntegrator,
                  percent(part), percent(at_half));
  if (std::abs(at_none) > kMostPart)
    return text + fmt::format(": by these two, {:.0f} % would stay however short it is", percent(at_none));
  const double factor = (std::copysign(kMostPart, part) - at_none) / (part - at_none);
  return text + fmt::format(": by these two, steps of about {:.2g} s would take {:.0f} %", factor * step,
                            100 * kMostShare);
}

}  // namespace hysteron::experiments
