#include "sim/reference/stops_law.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hysteron {
namespace {

// Returns, but for a constant, the loss of a stop that slips forward to x over its stiffness: int r dx -
// r^2/2 with the limit r at x, since S = x - r.
double lost_forward(double r, double a, double x) {
  const double limit = r + a * std::abs(x);
  return r * x + a * x * std::abs(x) / 2 - limit * limit / 2;
}

// Returns the loss of a stop that began to slip where its limit met the strain, over its stiffness.
double growing_loss(double r, double a, double anchor, double x) {
  if (x < anchor) return growing_loss(r, a, -anchor, -x);
  const double reach = anchor + r, onset = reach / (reach < 0 ? 1 + a : 1 - a);
  return lost_forward(r, a, x) - lost_forward(r, a, onset);
}

}  // namespace

double StopsLaw::initial_stiffness() const {
  return std::accumulate(stiffnesses.begin(), stiffnesses.end(), spring);
}

double StopsLaw::friction() const {
  return std::inner_product(stiffnesses.begin(), stiffnesses.end(), thresholds.begin(), 0.0);
}

StopsPoint respond(const StopsLaw& law, const double* anchors, double x) {
  StopsPoint at{law.spring * x, law.spring, law.spring * x * x / 2, 0};
  for (int j = 0; j < law.stops(); ++j) {
    const double p = law.stiffnesses[j], r = law.thresholds[j], a = law.growth(j), u = x - anchors[j];
    const double limit = r + a * std::abs(x), held = std::clamp(u, -limit, limit);
    at.response += p * held;
    at.stored += p * held * held / 2;
    if (held == u) {
      at.tangent += p;
    } else if (a == 0) {
      at.dissipated += p * r * (std::abs(u) - r);
    } else {
      at.tangent += std::copysign(p * a, x * held);
      at.dissipated += p * growing_loss(r, a, anchors[j], x);
    }
  }
  return at;
}

void accept(const StopsLaw& law, double* anchors, double x) {
  for (int j = 0; j < law.stops(); ++j) {
    const double r = law.thresholds[j] + law.growth(j) * std::abs(x);
    anchors[j] = x - std::clamp(x - anchors[j], -r, r);
  }
}

}  // namespace hysteron
