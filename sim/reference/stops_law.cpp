#include "sim/reference/stops_law.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hysteron {

double StopsLaw::initial_stiffness() const {
  return std::accumulate(stiffnesses.begin(), stiffnesses.end(), spring);
}

double StopsLaw::friction() const {
  return std::inner_product(stiffnesses.begin(), stiffnesses.end(), thresholds.begin(), 0.0);
}

StopsPoint respond(const StopsLaw& law, const double* anchors, double x) {
  StopsPoint at{law.spring * x, law.spring, law.spring * x * x / 2, 0};
  for (int j = 0; j < law.stops(); ++j) {
    const double p = law.stiffnesses[j], r = law.thresholds[j], u = x - anchors[j];
    const double held = std::clamp(u, -r, r);
    at.response += p * held;
    at.stored += p * held * held / 2;
    if (held == u)
      at.tangent += p;
    else
      at.dissipated += p * r * (std::abs(u) - r);
  }
  return at;
}

void accept(const StopsLaw& law, double* anchors, double x) {
  for (int j = 0; j < law.stops(); ++j) {
    const double r = law.thresholds[j];
    anchors[j] = x - std::clamp(x - anchors[j], -r, r);
  }
}

}  // namespace hysteron
