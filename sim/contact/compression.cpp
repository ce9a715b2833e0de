#include "sim/contact/compression.h"

namespace hysteron {

double barrier_stiffness(double thickness) {
  const double range = (1 - kHardest) * thickness, gap = range - kCompressed * thickness;
  return -kTestPressure / barrier(1.0, gap, range).slope;
}

ObstacleShell<double> obstacle_activation_distance(const Scene& scene) {
  ObstacleShell<double> activation_distance{
      scene.fabric.thickness, 1, scene.finds_equilibrium() ? kCrushed * scene.fabric.thickness : 0, 0};
  activation_distance.k = scene.contact_stiffness > 0
                              ? scene.contact_stiffness / activation_distance.stiffest()
                              : barrier_stiffness(scene.fabric.thickness);
  if (activation_distance.last > 0)
    activation_distance.yield = distance_under(activation_distance, kYieldPressure);
  return activation_distance;
}

double distance_under(const ObstacleShell<double>& activation_distance, double pressure) {
  const Barrier<double> surface = activation_distance.at(0);
  if (-surface.slope < pressure) return -(pressure + surface.slope) / surface.stiffness;  // inside the solid
  double low = 0, high = activation_distance.thickness;
  constexpr double kWithin = 1e-12;  // over the thickness
  while (high - low > kWithin * activation_distance.thickness) {
    const double middle = (low + high) / 2;
    (-activation_distance.at(middle).slope > pressure ? low : high) = middle;
  }
  return high;
}

}  // namespace hysteron
