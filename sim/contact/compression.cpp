#include "sim/contact/compression.h"

namespace hysteron {

double barrier_stiffness(double thickness) {
  const double range = (1 - kHardest) * thickness, gap = range - kCompressed * thickness;
  return -kTestPressure / barrier(1.0, gap, range).slope;
}

ObstacleResponse<double> obstacle_response(const Scene& scene) {
  ObstacleResponse<double> response{scene.fabric.thickness, 1,
                                    scene.finds_equilibrium() ? kCrushed * scene.fabric.thickness : 0, 0};
  response.k = scene.contact_stiffness > 0 ? scene.contact_stiffness / response.stiffest()
                                           : barrier_stiffness(scene.fabric.thickness);
  if (response.last > 0) response.yield = distance_under(response, kYieldPressure);
  return response;
}

double distance_under(const ObstacleResponse<double>& response, double pressure) {
  const Barrier<double> surface = response.at(0);
  if (-surface.slope < pressure) return -(pressure + surface.slope) / surface.stiffness;  // inside the solid
  double low = 0, high = response.thickness;
  constexpr double kWithin = 1e-12;  // over the thickness
  while (high - low > kWithin * response.thickness) {
    const double middle = (low + high) / 2;
    (-response.at(middle).slope > pressure ? low : high) = middle;
  }
  return high;
}

}  // namespace hysteron
